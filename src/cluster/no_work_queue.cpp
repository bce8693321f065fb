// Stands in for the engine where the program is built without CCTools.
#include "cluster/work_queue_engine.hpp"

namespace formotion {

std::unique_ptr<Engine> make_work_queue_engine(const WorkQueueOptions&, Quarantine&,
                                               const std::function<void(const Incident&)>&) {
  throw EngineError(
      "this program was built without Work Queue; install coop-computing-tools and coop-computing-tools-dev and build "
      "it again");
}

}  // namespace formotion
