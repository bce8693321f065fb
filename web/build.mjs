// Bundles the page into one HTML file and writes it as C++ source. Arguments: node_modules, page.html, page.cpp.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [modules, htmlOut, cppOut] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const { build } = createRequire(join(modules, 'page.cjs'))('esbuild');

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, 'src', entry)],
    nodePaths: [modules],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2020',
    charset: 'ascii',
    legalComments: 'eof', // the notices that the licences ask to keep
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

const script = (await bundle('main.js')).replaceAll('</script', '<\\/script');
const style = (await bundle('style.css')).replaceAll('</style', '<\\/style');
const html = readFileSync(join(here, 'index.html'), 'utf8')
  .replace('/* style.css */', () => style)
  .replace('/* main.js */', () => script);
writeFileSync(htmlOut, html);

// A string literal in pieces: compilers limit the length of one, and none may end inside an escape.
const bytes = Buffer.from(html, 'utf8');
const pieces = [];
for (let at = 0; at < bytes.length; at += 100) {
  let text = '';
  for (const byte of bytes.subarray(at, at + 100)) {
    const plain = byte >= 32 && byte < 127 && byte !== 34 && byte !== 92 && byte !== 63;
    text += plain ? String.fromCharCode(byte) : `\\${byte.toString(8).padStart(3, '0')}`;
  }
  pieces.push(`    "${text}"`);
}
writeFileSync(
  cppOut,
  `// Written by web/build.mjs.\n#include "formotion_page.hpp"\n\nnamespace formotion {\nnamespace {\n\n` +
    `constexpr char kPage[] =\n${pieces.join('\n')};\n\n}  // namespace\n\n` +
    `std::string_view page_template() { return {kPage, sizeof(kPage) - 1}; }\n\n}  // namespace formotion\n`,
);
