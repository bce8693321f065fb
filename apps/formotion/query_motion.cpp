// query: motion.
#include "analysis/contact/clearance.hpp"
#include "analysis/motion/contact_law.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

constexpr std::size_t kMostContacts = 8;  // 4 modes each

const char* name(ContactMode mode) {
  switch (mode) {
    case ContactMode::Break:
      return "break";
    case ContactMode::Stick:
      return "sticking";
    case ContactMode::SlideLeft:
      return "sliding-left";
    case ContactMode::SlideRight:
      return "sliding-right";
  }
  return "break";
}

OrderedJson wrench_json(const ContactPoint& contact, const ContactForce& force) {
  const Point f = force.normal * contact.normal + force.tangential * turned_left(contact.normal);
  return {f.x() + 0.0, f.y() + 0.0, cross(contact.lever, f) + 0.0};
}

}  // namespace

bool overlaps(const QueriedWorld& world, const Configuration& q, double tolerance_mm, IssueList& issues) {
  const double mm = clearance_mm(world.part, world.obstacles, q);
  if (mm >= -tolerance_mm) return false;
  issues.add("/q", "a part that overlaps what is fixed by " + OrderedJson(-mm).dump() + " mm", "a free configuration");
  return true;
}

OrderedJson motion_answer(const QueriedWorld& world, const MotionLaw& law, const Configuration& q, double tolerance_mm,
                          IssueList& issues) {
  if (overlaps(world, q, tolerance_mm, issues)) return {};
  std::vector<ContactPoint> points;
  for (const Contact& contact : contacts_at(world.part, world.obstacles, q, tolerance_mm))
    points.push_back({contact.state.normal, contact.state.lever});
  if (points.size() > kMostContacts) {
    issues.add("/q", std::to_string(points.size()) + " contacts at once",
               "at most " + std::to_string(kMostContacts) + ", or a smaller tolerance_mm");
    return {};
  }
  OrderedJson motions = OrderedJson::array();
  for (const Motion& motion : consistent_motions(points, law)) {
    OrderedJson json;
    json["twist"] = {motion.twist.linear.x() + 0.0, motion.twist.linear.y() + 0.0, motion.twist.angular + 0.0};
    json["modes"] = OrderedJson::array();
    json["wrenches"] = OrderedJson::array();
    for (std::size_t i = 0; i < points.size(); ++i) {
      json["modes"].push_back(name(motion.modes[i]));
      json["wrenches"].push_back(wrench_json(points[i], motion.forces[i]));
    }
    motions.push_back(std::move(json));
  }
  OrderedJson answer{{"motions", motions}};
  answer.update(contacts_answer(world, q, tolerance_mm));  // what the modes are of, in this order
  return answer;
}

OrderedJson way_answer(const Projection& projection, const std::string& outcome) {
  OrderedJson path = OrderedJson::array();
  const auto add = [&path](const Configuration& at, const OrderedJson& event) {
    path.push_back(configuration_json(at));
    path.back()["event"] = event;
  };
  for (const Leg& leg : projection.legs) {
    add(leg.start, leg.event);
    for (const Configuration& between : leg.between) add(between, nullptr);
  }
  add(projection.last, projection.end == ProjectionEnd::Steady   ? OrderedJson("goes on for ever")
                       : projection.end == ProjectionEnd::AtRest ? OrderedJson("rests")
                                                                 : OrderedJson("ends here"));
  OrderedJson answer{{"outcome", outcome}, {"path", path}};
  answer["why"] = projection.why;
  return answer;
}

}  // namespace formotion
