#include "analysis/geometry/polygon.hpp"
#include "applications/feeder/track_layout.hpp"
#include "io/dxf_import.hpp"
#include "io/problem_reader.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kTypes{"balcony", "gap",   "canyon",    "slot",  "cutout", "dish-out", "scallop",
                                      "drawing", "wiper", "hold-down", "fence", "wall",   "pin"};

// One feature being read: its keys and where its issues go.
struct FeatureReader {
  ObjectReader& object;
  ReadContext& context;
  Json& canonical;  // the same feature in the canonical document

  Affine expression(const std::string& key) { return object.expression(key, context.names); }

  // A length: literal ones are checked here, those with variables when they have values.
  Affine length(const std::string& key) {
    Affine value = expression(key);
    if (value.is_literal() && value.constant < 0)
      context.issues.add(object.at(key), Json(value.constant).dump(), "a number of at least 0");
    return value;
  }
};

feeder::Canyon read_band(FeatureReader& f) {
  feeder::Canyon band{f.expression("from_mm"), f.expression("to_mm"), f.length("length_mm")};
  const auto given = [&](const std::string& key) { return f.canonical.contains(key) && f.canonical[key].is_number(); };
  if (given("from_mm") && given("to_mm") && band.from_mm.constant >= band.to_mm.constant) {
    f.context.issues.add(f.object.at("from_mm"), Json(band.from_mm.constant).dump(), "a number below to_mm");
  }
  return band;
}

// Corners under a key; those without variables are checked here: defect_of says what is wrong, expected what is right.
template <class DefectOf>
AffineLoop read_corners(FeatureReader& f, const std::string& key, std::size_t least, const DefectOf& defect_of,
                        const std::string& expected) {
  const std::string wanted = "at least " + std::string(least == 3 ? "three" : "two") + " corners [[x, y], ...]";
  const Json* given = f.object.require(key, wanted);
  if (!given) return {};
  AffineLoop corners = read_loop(*given, f.object.at(key), f.context, least);
  if (!corners.empty() && corners.size() == given->size() && is_literal(corners)) {
    if (const std::optional<std::string> found = defect_of(constant_loop(corners)))
      f.context.issues.add(f.object.at(key), *found, expected);
  }
  return corners;
}

AffineLoop read_polygon(FeatureReader& f) {
  const auto defect_of = [](const Loop& loop) { return defect(normalised({loop, {}})); };
  return read_corners(f, "polygon_mm", 3, defect_of, "a simple polygon with area");
}

feeder::Pin read_pin(FeatureReader& f) {
  feeder::Pin pin{f.expression("x_mm"), f.expression("y_mm"), f.expression("diameter_mm")};
  const auto given = f.canonical.find("diameter_mm");
  if (pin.diameter_mm.is_literal() && given != f.canonical.end() && given->is_number() &&
      pin.diameter_mm.constant <= 0) {
    f.context.issues.add(f.object.at("diameter_mm"), Json(pin.diameter_mm.constant).dump(), "a number above 0");
  }
  return pin;
}

feeder::DishOut read_dish_out(FeatureReader& f) {
  feeder::DishOut dish{f.length("depth_mm"), f.length("length_mm")};
  if (dish.depth_mm.is_literal() && dish.length_mm.is_literal() &&
      dish.depth_mm.constant > dish.length_mm.constant / 2) {
    f.context.issues.add(f.object.at("depth_mm"), Json(dish.depth_mm.constant).dump(),
                         "at most half of length_mm: the dish is an arc of a circle");
  }
  return dish;
}

feeder::Scallop read_scallop(FeatureReader& f) {
  feeder::Scallop scallop{f.length("depth_mm"), f.expression("half_angle_deg")};
  if (scallop.half_angle_rad.is_literal() && f.canonical.contains("half_angle_deg") &&
      !(scallop.half_angle_rad.constant > 0 && scallop.half_angle_rad.constant < 89.9)) {
    f.context.issues.add(f.object.at("half_angle_deg"), Json(scallop.half_angle_rad.constant).dump(),
                         "an angle above 0 and below 89.9 degrees");
  }
  scallop.half_angle_rad = in_radians(scallop.half_angle_rad);
  return scallop;
}

std::vector<Loop> read_literal_loops(FeatureReader& f, const std::string& key) {
  std::vector<Loop> loops;
  const Json* value = f.object.find(key);
  for (const AffineLoop& loop : read_loops(value, f.object.at(key), f.context)) {
    if (!is_literal(loop)) f.context.issues.add(f.object.at(key), "expressions", "numbers: a drawing has no variables");
    if (const auto found = defect(normalised({constant_loop(loop), {}})))
      f.context.issues.add(f.object.at(key), *found, "simple polygons");
    loops.push_back(constant_loop(loop));
  }
  return loops;
}

// An existing track: from a DXF file, or (as in results) with its contours written out.
feeder::Drawing read_drawing(FeatureReader& f) {
  feeder::Drawing drawing;
  const auto file = f.object.string("file");
  drawing.voids_mm = read_literal_loops(f, "voids_mm");
  drawing.walls_mm = read_literal_loops(f, "walls_mm");
  if (!drawing.voids_mm.empty() || !drawing.walls_mm.empty()) {
    drawing.file = file.value_or("");
    return drawing;
  }
  if (!file) {
    if (f.object.valid() && !f.canonical.contains("file"))
      f.context.issues.add(f.object.at("file"), "nothing", "a DXF file's name");
    return drawing;
  }
  drawing.file = *file;
  try {
    DxfOptions options;
    options.layers = {"VOID", "WALL"};
    for (DxfContour& contour : read_dxf(resolved(*file, f.context), options)) {
      (contour.layer == "WALL" ? drawing.walls_mm : drawing.voids_mm).push_back(std::move(contour.points_mm));
    }
    if (drawing.voids_mm.empty() && drawing.walls_mm.empty()) {
      f.context.issues.add(f.object.at("file"), "a drawing without contours on the layers VOID and WALL",
                           "at least one");
    }
  } catch (const InputError& error) {
    f.context.issues.issues.insert(f.context.issues.issues.end(), error.issues.begin(), error.issues.end());
  }
  f.canonical["voids_mm"] = loops_json(drawing.voids_mm);
  f.canonical["walls_mm"] = loops_json(drawing.walls_mm);
  return drawing;
}

void read_shape(const std::string& type, FeatureReader& f, feeder::FeatureSpec& spec) {
  if (type == "balcony") {
    spec.shape = feeder::Balcony{f.length("width_mm"), f.length("length_mm")};
  } else if (type == "gap") {
    spec.shape = feeder::Gap{f.length("length_mm")};
  } else if (type == "canyon") {
    spec.shape = read_band(f);
  } else if (type == "slot") {
    const feeder::Canyon band = read_band(f);
    spec.shape = feeder::Slot{band.from_mm, band.to_mm, band.length_mm};
  } else if (type == "cutout") {
    spec.shape = feeder::Cutout{read_polygon(f)};
  } else if (type == "dish-out") {
    spec.shape = read_dish_out(f);
  } else if (type == "scallop") {
    spec.shape = read_scallop(f);
  } else if (type == "drawing") {
    spec.shape = read_drawing(f);
  } else if (type == "wiper") {
    spec.shape = feeder::Wiper{f.length("height_mm")};
  } else if (type == "fence") {
    spec.shape = feeder::Fence{read_polygon(f)};
  } else if (type == "wall") {
    spec.shape = feeder::WallProfile{read_corners(f, "profile_mm", 2, feeder::profile_defect,
                                                  "a polyline from its least to its largest x that does not cross "
                                                  "itself")};
  } else if (type == "pin") {
    spec.shape = read_pin(f);
  } else {
    spec.shape = feeder::HoldDown{f.length("height_mm"), f.length("length_mm")};
  }
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

feeder::DesignSpec read_features(const Json& features, const std::string& pointer, ReadContext& context,
                                 Json& canonical) {
  feeder::DesignSpec design;
  if (!features.is_array() || features.empty()) {
    context.issues.add(pointer, described(features), "an array of at least one feature");
    return design;
  }
  for (std::size_t i = 0; i < features.size(); ++i) {
    ObjectReader object(features[i], pointer + "/" + std::to_string(i), context.issues);
    if (!object.valid()) continue;
    object.require("type", "a feature's type: " + list(kTypes));
    const auto type = object.string("type");
    if (!type) continue;
    if (std::find(kTypes.begin(), kTypes.end(), *type) == kTypes.end()) {
      context.issues.add(object.at("type"), "the unknown type '" + *type + "'" + did_you_mean(*type, kTypes),
                         "one of " + list(kTypes));
      continue;
    }
    feeder::FeatureSpec spec;
    FeatureReader reader{object, context, canonical[i]};
    read_shape(*type, reader, spec);
    if (features[i].contains("at_mm")) spec.at_mm = reader.expression("at_mm");
    object.ignore({"at_mm"});
    object.finish();
    design.push_back(std::move(spec));
  }
  return design;
}

}  // namespace formotion
