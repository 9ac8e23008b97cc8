// A world in Python's hands, and the memory that arrays look at while it goes on.
#pragma once

#include "arrays.h"
#include "bindings.h"
#include "simulation/world_state.h"

namespace brisance::python {

class WorldHandle;

/// Memory of a world that is lent to arrays. It can be kept for them when the world goes on.
class Loan {
 public:
  virtual ~Loan() = default;
  /// The memory becomes the loan's own; the world goes on with a copy.
  virtual void keep() = 0;
};

template <class Vector>
class VectorLoan : public Loan {
 public:
  VectorLoan(std::shared_ptr<WorldHandle> world, Vector& lent) : world_(std::move(world)), lent_(&lent) {}
  void keep() override {
    Vector copy = *lent_;
    kept_ = std::move(*lent_);
    *lent_ = std::move(copy);
    world_.reset();
  }

 private:
  std::shared_ptr<WorldHandle> world_;  ///< none once the memory is kept
  Vector* lent_;
  Vector kept_;
};

/// One call at a time works in it. All functions are called with the interpreter's lock.
class WorldHandle : public std::enable_shared_from_this<WorldHandle> {
 public:
  explicit WorldHandle(std::shared_ptr<SceneHandle> scene);

  /// One frame. Raises what a signal's handler raised; the world is then what it was before the call, or, where the
  /// frame came to its end first, one frame on.
  void step();
  std::shared_ptr<Frame> capture();
  const SceneHandle& scene() const { return *scene_; }
  const std::shared_ptr<SceneHandle>& sharedScene() const { return scene_; }
  /// Throws Error while another thread works in it.
  WorldState& state();

  /// A view of a vector of the state.
  template <class Vector>
  py::array lend(Vector& vector) {
    return viewOf(vector, loanOf(vector));
  }
  template <class T>
  py::array lend(Grid3<T>& grid) {
    return viewOf(grid, loanOf(grid.values));
  }

 private:
  class Work;
  template <class Vector>
  std::shared_ptr<Loan> loanOf(Vector& vector) {
    const void* place = &vector;
    if (auto known = loans_[place].lock()) return known;
    auto loan = std::make_shared<VectorLoan<Vector>>(shared_from_this(), vector);
    loans_[place] = loan;
    return loan;
  }
  /// Arrays keep showing what they show.
  void keepLoans();

  std::shared_ptr<SceneHandle> scene_;
  World world_;
  std::map<const void*, std::weak_ptr<Loan>> loans_;  ///< by the vector that is lent
  bool busy_ = false;
};

}  // namespace brisance::python
