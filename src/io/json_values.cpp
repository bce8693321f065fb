#include "io/json_values.hpp"

namespace formotion {

using Json = nlohmann::ordered_json;

Json used_values_json(const Problem& problem, int topology, std::span<const double> values) {
  Json json = Json::object();
  for (const int index : problem.topologies()[static_cast<std::size_t>(topology)].variables) {
    json[problem.variables()[static_cast<std::size_t>(index)].name] = values[static_cast<std::size_t>(index)] + 0.0;
  }
  return json;
}

Json region_json(const std::vector<OutcomeRegion>& regions, const std::vector<double>& y_mm, int outcomes,
                 const char* (*name)(int)) {
  if (regions.empty()) return nullptr;
  const std::size_t middle = regions.size() / 2;
  const OutcomeRegion& region = regions[middle];
  Json json{{"x_mm", {number_json(region.box.u_min), number_json(region.box.u_max)}},
            {"y_mm", number_json(y_mm[middle])},
            {"theta_deg", {degrees_json(region.box.v_min), degrees_json(region.box.v_max)}},
            {"shares", Json::object()},
            {"rows", Json::array()}};
  for (int outcome = 0; outcome < outcomes; ++outcome) {
    const double share = share_of(region, outcome);
    if (share > 0) json["shares"][name(outcome)] = number_json(share);
  }
  for (const RegionRow& row : region.rows) {
    Json intervals = Json::array();
    for (const RegionInterval& interval : row.intervals)
      intervals.push_back({number_json(interval.from), number_json(interval.to), name(interval.outcome)});
    json["rows"].push_back({{"theta_deg", degrees_json(row.v)}, {"intervals", std::move(intervals)}});
  }
  return json;
}

}  // namespace formotion
