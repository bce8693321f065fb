#include "applications/shared/worst_members.hpp"

#include <algorithm>
#include <vector>

namespace formotion {
namespace {

std::vector<Member> single_ends(const ShapeUncertainty& u, const std::string& centre_name) {
  std::vector<Member> members;
  for (const auto& [name, range] : u.intervals) {
    for (const double end : {range.first, range.second}) members.push_back({name, {{name, end}}, 0, Point::Zero()});
  }
  for (const auto& [name, by] : {std::pair{"outline_mm", u.outline_mm}, {"feature_mm", u.feature_mm}}) {
    for (const double end : {-by, by}) {
      if (by > 0) members.push_back({name, {}, end, Point::Zero()});
    }
  }
  for (const Point& way : {Point(1, 0), Point(-1, 0), Point(0, 1), Point(0, -1)}) {
    if (u.centre_mm > 0) members.push_back({centre_name, {}, 0, u.centre_mm * way});
  }
  return members;
}

}  // namespace

std::optional<std::string> judge_ends(const ShapeUncertainty& uncertainty, const std::string& centre_name,
                                      double nominal_loss, const std::function<double(const Member&)>& loss) {
  std::map<std::string, std::pair<double, Member>> worse;  // the worse end of every quantity
  std::optional<std::string> bites;
  double bite = 0;
  for (const Member& member : single_ends(uncertainty, centre_name)) {
    const double by = loss(member) - nominal_loss;
    if (!worse.count(member.name) || by > worse[member.name].first) worse[member.name] = {by, member};
    if (by > bite || !bites) {
      bite = std::max(bite, by);
      bites = member.name;
    }
  }
  if (worse.size() < 2) return bites;
  Member all;
  for (const auto& [name, end] : worse) {
    all.values.insert(end.second.values.begin(), end.second.values.end());
    all.grow_mm += end.second.grow_mm;
    all.centre_off_mm += end.second.centre_off_mm;
  }
  loss(all);
  return bites;
}

}  // namespace formotion
