// The landscape's cells as a picture of pixels.

import { restColour } from './nest_rests.js';

const kPalest = 0.82; // share of white of the highest cells
const kDarkest = 0.12;

// A pixel a cell; the first row once more on top.
export function cellsPicture(land, nest, low, high) {
  const [rows, columns] = [land.heights_mm.length, land.heights_mm[0].length];
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [columns, rows + 1];
  const context = canvas.getContext('2d');
  const image = context.createImageData(columns, rows + 1);
  for (let r = 0; r <= rows; ++r) {
    for (let c = 0; c < columns; ++c) {
      const height = land.heights_mm[r % rows][c];
      if (height === null) continue;
      const hex = restColour(nest, land.basin[r % rows][c]);
      const white = high > low ? kDarkest + (kPalest - kDarkest) * ((height - low) / (high - low)) : 0.3;
      const at = 4 * ((rows - r) * columns + c);
      for (let k = 0; k < 3; ++k) {
        const value = Number.parseInt(hex.slice(1 + 2 * k, 3 + 2 * k), 16);
        image.data[at + k] = Math.round(value + white * (255 - value));
      }
      image.data[at + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
  return canvas.toDataURL('image/png');
}
