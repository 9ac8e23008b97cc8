#include "fracture/solid_parts.h"

namespace brisance {
namespace {

constexpr int nobody = -1;

class Joiner {
 public:
  explicit Joiner(const CellAtoms& atoms) : atoms_(atoms), pieceOf_(atoms.atoms.size(), nobody) {}

  Partition join(int pieces) {
    for (std::size_t a = 0; a < pieceOf_.size(); ++a)
      if (a == 0 || atoms_.atoms[a].cell != atoms_.atoms[a - 1].cell) pieceOf_[a] = count_++;
    spread();
    for (int alone = largestAlone(); alone != nobody; alone = largestAlone()) {
      pieceOf_[alone] = count_++;
      spread();
    }
    while (count_ > pieces && joinSmallest()) {
    }
    return {pieceOf_, count_};
  }

 private:
  /// Atoms without piece join the neighbour of most area that has one, until none is left that can.
  void spread() {
    while (joinNeighbours()) {
    }
  }
  bool joinNeighbours() {
    std::vector<double> area(pieceOf_.size(), -1);
    std::vector<int> into(pieceOf_.size(), nobody);
    const auto offer = [&](int from, int to, double shared) {
      if (pieceOf_[from] != nobody || pieceOf_[to] == nobody || shared <= area[from]) return;
      area[from] = shared;
      into[from] = pieceOf_[to];
    };
    for (const Contact& c : atoms_.contacts) {
      offer(c.a, c.b, c.area);
      offer(c.b, c.a, c.area);
    }
    bool changed = false;
    for (std::size_t a = 0; a < into.size(); ++a) {
      if (into[a] == nobody) continue;
      pieceOf_[a] = into[a];
      changed = true;
    }
    return changed;
  }

  int largestAlone() const {
    int largest = nobody;
    for (std::size_t a = 0; a < pieceOf_.size(); ++a)
      if (pieceOf_[a] == nobody && (largest == nobody || atoms_.atoms[a].volume > atoms_.atoms[largest].volume))
        largest = static_cast<int>(a);
    return largest;
  }

  /// The smallest piece that touches another joins the one of most area.
  bool joinSmallest() {
    std::vector<double> volume(count_, 0);
    for (std::size_t a = 0; a < pieceOf_.size(); ++a) volume[pieceOf_[a]] += atoms_.atoms[a].volume;
    std::vector<bool> touches(count_, false);
    for (const Contact& c : atoms_.contacts)
      if (pieceOf_[c.a] != pieceOf_[c.b]) touches[pieceOf_[c.a]] = touches[pieceOf_[c.b]] = true;
    int smallest = nobody;
    for (int p = 0; p < count_; ++p)
      if (touches[p] && (smallest == nobody || volume[p] < volume[smallest])) smallest = p;
    if (smallest == nobody) return false;
    const int into = widestNeighbour(smallest);
    --count_;
    for (int& piece : pieceOf_) {
      if (piece == smallest) piece = into;
      if (piece > smallest) --piece;
    }
    return true;
  }

  int widestNeighbour(int piece) const {
    std::vector<double> area(count_, -1);
    for (const Contact& c : atoms_.contacts) {
      const int a = pieceOf_[c.a], b = pieceOf_[c.b];
      if (a == b || (a != piece && b != piece)) continue;
      area[a == piece ? b : a] = std::max(area[a == piece ? b : a], 0.0) + c.area;
    }
    return static_cast<int>(std::max_element(area.begin(), area.end()) - area.begin());
  }

  const CellAtoms& atoms_;
  std::vector<int> pieceOf_;
  int count_ = 0;
};

}  // namespace

Partition cellPieces(const CellAtoms& atoms, int pieces) { return Joiner(atoms).join(pieces); }

}  // namespace brisance
