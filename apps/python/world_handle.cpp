#include "world_handle.h"

#include "base/check.h"
#include "interruption.h"

namespace brisance::python {
namespace {

World worldOf(const SimulationSettings& settings) {
  return interruptibly([&] { return World(settings); });
}

}  // namespace

WorldHandle::WorldHandle(std::shared_ptr<SceneHandle> scene)
    : scene_(std::move(scene)), world_(worldOf(scene_->scene().simulation)) {}

/// Marks the world as worked in, while it lives.
class WorldHandle::Work {
 public:
  explicit Work(WorldHandle& world) : world_(world) {
    world.state();
    world.busy_ = true;
  }
  ~Work() { world_.busy_ = false; }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

 private:
  WorldHandle& world_;
};

WorldState& WorldHandle::state() {
  if (busy_) throw Error(ExitCode::failed, "world: another thread works in it; look at it between two steps");
  return world_.state();
}

void WorldHandle::keepLoans() {
  for (auto& [place, lent] : loans_)
    if (const auto loan = lent.lock()) loan->keep();
  loans_.clear();
}

void WorldHandle::step() {
  const Work work(*this);
  keepLoans();
  interruptibly([&] { world_.advanceOrStay(); });
}

std::shared_ptr<Frame> WorldHandle::capture() {
  const Work work(*this);
  return interruptibly([&] { return std::make_shared<Frame>(world_.capture()); });
}

}  // namespace brisance::python
