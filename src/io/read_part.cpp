#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "io/dxf_import.hpp"
#include "io/problem_reader.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
constexpr Range kProbability{0, 1, false};

std::optional<Point> read_point(const Json* value, const std::string& pointer, IssueList& issues) {
  if (!value) return std::nullopt;
  if (!value->is_array() || value->size() != 2) {
    issues.add(pointer, described(*value), "a point [x, y]");
    return std::nullopt;
  }
  const auto x = read_number((*value)[0], pointer + "/0", kAny, issues);
  const auto y = read_number((*value)[1], pointer + "/1", kAny, issues);
  return x && y ? std::optional<Point>({*x, *y}) : std::nullopt;
}

// Shapes whose numbers are all literal are checked here; those with variables when they have values.
void check_shape(const AffineLoop& outline, const std::vector<AffineLoop>& holes, const std::string& pointer,
                 const std::optional<Point>& com, IssueList& issues) {
  if (outline.empty() || !is_literal(outline) || !std::all_of(holes.begin(), holes.end(), is_literal)) return;
  Polygon polygon{constant_loop(outline), {}};
  for (const AffineLoop& hole : holes) polygon.holes.push_back(constant_loop(hole));
  polygon = normalised(std::move(polygon));
  // The keys beside the outline's.
  const std::string beside = pointer.substr(0, pointer.rfind('/') + 1);
  if (const auto found = defect(polygon)) {
    const bool of_hole = found->rfind("hole ", 0) == 0;
    const std::string number = of_hole ? found->substr(5, found->find(' ', 5) - 5) : "";
    issues.add(of_hole ? beside + "holes_mm/" + number : pointer, *found,
               "a simple polygon with area, holes inside of it and apart");
  } else if (com && locate(convex_hull(polygon.outer), *com, 1e-9) == Side::Outside) {
    issues.add(beside + "com_mm", "a centre of mass outside of the outline's hull",
               "one that some distribution of mass can have");
  }
}

std::vector<feeder::LayerSpec> read_layers(const Json* value, const std::string& pointer, ReadContext& context) {
  std::vector<feeder::LayerSpec> layers;
  if (!value) return layers;
  if (!value->is_array() || value->empty()) {
    context.issues.add(pointer, described(*value), "an array of layers, from the track upwards");
    return layers;
  }
  for (std::size_t i = 0; i < value->size(); ++i) {
    const std::string at = pointer + "/" + std::to_string(i);
    ObjectReader layer((*value)[i], at, context.issues);
    feeder::LayerSpec spec;
    spec.from_mm = layer.required_number("from_mm", kNotNegative);
    spec.to_mm = layer.required_number("to_mm", kPositive);
    if (layer.valid() && spec.to_mm <= spec.from_mm)
      context.issues.add(at + "/to_mm", std::to_string(spec.to_mm), "a height above from_mm");
    if (!layers.empty() && spec.from_mm < layers.back().to_mm) {
      context.issues.add(at + "/from_mm", std::to_string(spec.from_mm),
                         "a layer that begins where the one before ends, or above");
    }
    if (const Json* outline = layer.require("outline_mm", "an outline"))
      spec.outline_mm = read_loop(*outline, at + "/outline_mm", context);
    spec.holes_mm = read_loops(layer.find("holes_mm"), at + "/holes_mm", context);
    layer.finish();
    check_shape(spec.outline_mm, spec.holes_mm, at + "/outline_mm", std::nullopt, context.issues);
    layers.push_back(std::move(spec));
  }
  return layers;
}

AffineLoop mirrored(AffineLoop loop) {
  for (AffinePoint& p : loop) {
    p[0].constant = -p[0].constant;
    for (auto& term : p[0].terms) term.second = -term.second;
  }
  return loop;
}

feeder::AspectSpec mirrored(const feeder::AspectSpec& up) {
  feeder::AspectSpec down = up;
  down.name = "down";
  down.outline_mm = mirrored(up.outline_mm);
  for (AffineLoop& hole : down.holes_mm) hole = mirrored(hole);
  if (down.com_mm) down.com_mm->x() = -down.com_mm->x();
  if (down.com_height_mm) down.com_height_mm = up.height_mm - *up.com_height_mm;
  // Turned over: the top layer becomes the footprint.
  std::reverse(down.layers.begin(), down.layers.end());
  for (feeder::LayerSpec& layer : down.layers) {
    const double from = up.height_mm - layer.to_mm;
    layer.to_mm = up.height_mm - layer.from_mm;
    layer.from_mm = from;
    layer.outline_mm = mirrored(layer.outline_mm);
    for (AffineLoop& hole : layer.holes_mm) hole = mirrored(hole);
  }
  return down;
}

// The keys that a part and an aspect share. file: the part's drawing, in place of outline and holes.
void read_shape(ObjectReader& object, feeder::AspectSpec& spec, bool outline_required, ReadContext& context) {
  if (const Json* outline = object.find("outline_mm")) {
    spec.outline_mm = read_loop(*outline, object.at("outline_mm"), context);
  } else if (outline_required && object.valid()) {
    context.issues.add(object.at("outline_mm"), "nothing", "an outline: [[x, y], ...]");
  }
  const std::vector<AffineLoop> holes = read_loops(object.find("holes_mm"), object.at("holes_mm"), context);
  spec.holes_mm.insert(spec.holes_mm.end(), holes.begin(), holes.end());
  spec.com_mm = read_point(object.find("com_mm"), object.at("com_mm"), context.issues);
  spec.com_height_mm = object.number("com_height_mm", kPositive);
  spec.layers = read_layers(object.find("layers"), object.at("layers"), context);
  if (!spec.layers.empty() && spec.height_mm > 0 && spec.layers.back().to_mm > spec.height_mm + 1e-9) {
    context.issues.add(object.at("layers"), "layers up to " + std::to_string(spec.layers.back().to_mm) + " mm",
                       "layers within the part's height");
  }
  if (spec.outline_mm.empty() && !spec.layers.empty()) spec.outline_mm = spec.layers.front().outline_mm;
  check_shape(spec.outline_mm, spec.holes_mm, object.at("outline_mm"), spec.com_mm, context.issues);
}

std::vector<feeder::AspectSpec> read_aspects(const Json& value, ReadContext& context) {
  std::vector<feeder::AspectSpec> aspects;
  if (!value.is_array() || value.empty()) {
    context.issues.add("/part/aspects", described(value), "an array of aspects");
    return aspects;
  }
  std::set<std::string> names;
  double sum = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    ObjectReader object(value[i], "/part/aspects/" + std::to_string(i), context.issues);
    feeder::AspectSpec aspect;
    const auto name = object.string("name");
    aspect.name = name.value_or("");
    if (object.valid() && (aspect.name.empty() || aspect.name == "any" || !names.insert(aspect.name).second)) {
      context.issues.add(object.at("name"), name ? "'" + aspect.name + "'" : "nothing",
                         "a name of its own (not 'any')");
    }
    aspect.height_mm = object.required_number("height_mm", kPositive, "the height of the part in this aspect");
    aspect.probability = object.required_number("probability", kProbability, "the probability of this aspect");
    sum += aspect.probability;
    read_shape(object, aspect, value[i].is_object() && !value[i].contains("layers"), context);
    object.finish();
    aspects.push_back(std::move(aspect));
  }
  if (std::abs(sum - 1) > 1e-9 && context.issues.issues.empty()) {
    context.issues.add("/part/aspects", "probabilities that sum to " + Json(sum).dump(), "a sum of 1");
  }
  return aspects;
}

// The outline and holes of a DXF file, in place of what a problem file would list; the canonical document lists them.
void read_drawn_part(const std::string& file, feeder::AspectSpec& up, ReadContext& context) {
  try {
    const Polygon drawn = read_dxf_part(resolved(file, context));
    Json& canonical = context.canonical["part"];
    const Json more = canonical.value("holes_mm", Json::array());
    Json holes = loops_json(drawn.holes);
    if (more.is_array()) holes.insert(holes.end(), more.begin(), more.end());
    canonical.erase("file");
    canonical["outline_mm"] = loop_json(drawn.outer);
    canonical["holes_mm"] = holes;
    up.outline_mm = literal_loop(drawn.outer);
    for (const Loop& hole : drawn.holes) up.holes_mm.push_back(literal_loop(hole));
  } catch (const InputError& error) {
    context.issues.issues.insert(context.issues.issues.end(), error.issues.begin(), error.issues.end());
  }
}

}  // namespace

void read_outlines(ObjectReader& object, const Json& part, feeder::AspectSpec& up, ReadContext& context) {
  bool outline_required = part.is_object() && !part.contains("layers");
  if (const auto file = object.string("file")) {
    outline_required = false;
    if (part.contains("outline_mm")) {
      context.issues.add("/part/file", "both file and outline_mm", "one of them");
    } else {
      read_drawn_part(*file, up, context);
    }
  }
  read_shape(object, up, outline_required, context);
}

feeder::PartSpec read_part(const Json& value, ReadContext& context, bool thickness_required) {
  feeder::PartSpec part;
  ObjectReader object(value, "/part", context.issues);
  if (const Json* aspects = object.find("aspects")) {
    part.aspects = read_aspects(*aspects, context);
    object.finish();
    return part;
  }
  feeder::AspectSpec up;
  up.name = "up";
  up.height_mm = thickness_required ? object.required_number("thickness_mm", kPositive, "the part's thickness")
                                    : object.number_or("thickness_mm", kPositive, 0);
  read_outlines(object, value, up, context);
  const bool flips = object.boolean_or("flips", false);
  object.finish();
  up.probability = flips ? 0.5 : 1;
  part.aspects.push_back(up);
  if (flips) part.aspects.push_back(mirrored(up));
  return part;
}

AffineLoop read_loop(const Json& value, const std::string& pointer, ReadContext& context, std::size_t least) {
  AffineLoop loop;
  if (!value.is_array() || value.size() < least) {
    const std::string count = least == 3 ? "three" : "two";
    context.issues.add(pointer, described(value), "at least " + count + " corners [[x, y], ...]");
    return loop;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string at = pointer + "/" + std::to_string(i);
    if (!value[i].is_array() || value[i].size() != 2) {
      context.issues.add(at, described(value[i]), "a corner [x, y]");
      continue;
    }
    const auto x = read_expression(value[i][0], at + "/0", context.names, context.issues);
    const auto y = read_expression(value[i][1], at + "/1", context.names, context.issues);
    if (x && y) loop.push_back({*x, *y});
  }
  return loop;
}

std::vector<AffineLoop> read_loops(const Json* value, const std::string& pointer, ReadContext& context) {
  std::vector<AffineLoop> loops;
  if (!value) return loops;
  if (!value->is_array()) {
    context.issues.add(pointer, described(*value), "an array of outlines");
    return loops;
  }
  for (std::size_t i = 0; i < value->size(); ++i)
    loops.push_back(read_loop((*value)[i], pointer + "/" + std::to_string(i), context));
  return loops;
}

Loop constant_loop(const AffineLoop& loop) {
  Loop points;
  for (const AffinePoint& p : loop) points.emplace_back(p[0].constant, p[1].constant);
  return points;
}

AffineLoop literal_loop(const Loop& loop) {
  AffineLoop affine;
  for (const Point& p : loop) affine.push_back({Affine{p.x(), {}}, Affine{p.y(), {}}});
  return affine;
}

bool is_literal(const AffineLoop& loop) {
  return std::all_of(loop.begin(), loop.end(),
                     [](const AffinePoint& p) { return p[0].is_literal() && p[1].is_literal(); });
}

Json loop_json(const Loop& loop) {
  Json json = Json::array();
  for (const Point& p : loop) json.push_back(Json::array({p.x(), p.y()}));
  return json;
}

Json loops_json(const std::vector<Loop>& loops) {
  Json json = Json::array();
  for (const Loop& loop : loops) json.push_back(loop_json(loop));
  return json;
}

Affine in_radians(Affine degrees) {
  constexpr double kRadians = std::numbers::pi / 180;
  degrees.constant *= kRadians;
  for (auto& term : degrees.terms) term.second *= kRadians;
  return degrees;
}

std::string resolved(const std::string& file, const ReadContext& context) {
  const std::filesystem::path path(file);
  return path.is_absolute() ? file : (std::filesystem::path(context.folder) / path).string();
}

}  // namespace formotion
