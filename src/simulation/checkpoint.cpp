#include "simulation/checkpoint.h"

#include <cstring>

#include "rigid/swelling.h"

namespace brisance {

namespace {
constexpr char magic[16] = "brisance-ckpt-4";

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    out_.write(reinterpret_cast<const char*>(&v), sizeof v);
  }
  template <class T, class Allocator>
  void array(const std::vector<T, Allocator>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(v.size()));
    out_.write(reinterpret_cast<const char*>(v.data()), static_cast<std::streamsize>(v.size() * sizeof(T)));
  }
  /// An array whose length the settings fix.
  template <class T, class Allocator>
  void fixedArray(const std::vector<T, Allocator>& v) {
    array(v);
  }

 private:
  std::ostream& out_;
};

class Reader {
 public:
  Reader(const std::string& bytes, const std::string& fileName) : bytes_(bytes), fileName_(fileName) {}

  template <class T>
  void value(T& v) {
    std::memcpy(static_cast<void*>(&v), take(sizeof v), sizeof v);
  }
  template <class T, class Allocator>
  void array(std::vector<T, Allocator>& v) {
    std::uint64_t count = 0;
    value(count);
    if (count > (bytes_.size() - at_) / sizeof(T)) refuse("ends in the middle");
    v.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(v.data()), take(count * sizeof(T)), count * sizeof(T));
  }
  template <class T, class Allocator>
  void fixedArray(std::vector<T, Allocator>& v) {
    const std::size_t expected = v.size();
    array(v);
    if (v.size() != expected) refuse("belongs to a scene of another size");
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw DamagedFile(fmt::format("{}: checkpoint {}: start again with --overwrite", fileName_, why));
  }
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  const char* take(std::size_t count) {
    if (count > bytes_.size() - at_) refuse("ends in the middle");
    at_ += count;
    return bytes_.data() + at_ - count;
  }
  const std::string& bytes_;
  std::string fileName_;
  std::size_t at_ = 0;
};

/// Shapes of bodies that swell or have swollen.
template <class Archive>
void archiveShapes(Archive& a, const WorldState& world) {
  for (std::size_t b = 0; b < world.bodies.size(); ++b)
    if (world.looks[b].deforms) a.array(world.bodies.mesh[b]->vertices);
}
void archiveShapes(Reader& reader, WorldState& world) {
  RigidBodies& bodies = world.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyLook& look = world.looks[b];
    if (!look.deforms) continue;
    TriangleMesh mesh = *bodies.mesh[b];
    reader.fixedArray(mesh.vertices);
    if (look.shapeFrame > 0) mesh.normals.clear();
    if (look.shapeFrame > 0 && !look.swelling)
      setHollowShape(bodies, b, std::move(mesh));
    else
      bodies.mesh[b] = std::make_shared<const TriangleMesh>(std::move(mesh));
  }
}

/// The order of fields, once for both directions. Solids are not in it: they come from the settings.
template <class Archive, class State>
void archive(Archive& a, State& world) {
  a.value(world.frame);
  a.value(world.time);
  a.value(world.largestSource);
  a.value(world.burning);
  a.value(world.totals);
  auto& gas = world.gas;
  for (auto* grid :
       {&gas.velocity.u, &gas.velocity.v, &gas.velocity.w, &gas.pressure, &gas.temperature, &gas.soot, &gas.flame})
    a.fixedArray(grid->values);
  for (auto* particles : {&world.particles, &world.sparks.particles, &world.dust.particles}) {
    forEachField(*particles, [&](auto& field) { a.array(field); });
    a.value(particles->nextId);
  }
  a.array(world.emitted);
  a.array(world.sparks.given);
  a.array(world.dust.given);
  auto& bodies = world.bodies;
  a.fixedArray(bodies.position);
  a.fixedArray(bodies.orientation);
  a.fixedArray(bodies.linearVelocity);
  a.fixedArray(bodies.angularVelocity);
  a.fixedArray(bodies.holds);
  a.array(bodies.passing);
  a.array(bodies.pressing);
  a.array(bodies.rest);
  for (auto& look : world.looks) {
    a.value(look.temperature);
    a.value(look.swelling);
    a.value(look.shapeFrame);
  }
  archiveShapes(a, world);
}
}  // namespace

void writeCheckpoint(const WorldState& world, std::ostream& out) {
  Writer writer(out);
  writer.value(magic);
  archive(writer, world);
}

void readCheckpoint(const std::string& bytes, const std::string& fileName, WorldState& world) {
  Reader reader(bytes, fileName);
  char start[sizeof magic];
  reader.value(start);
  if (std::memcmp(start, magic, sizeof magic) != 0) reader.refuse("is of another version of Brisance");
  archive(reader, world);
  for (const BodyPair& pair : world.bodies.passing)
    if (pair.a >= world.bodies.size() || pair.b >= world.bodies.size())
      reader.refuse("names bodies that are not there");
  if (!world.bodies.rest.empty() && world.bodies.rest.size() != world.bodies.size())
    reader.refuse("tells of the rest of other bodies than there are");
  if (!reader.atEnd()) reader.refuse("has bytes left over");
  for (ParticleSet* particles : {&world.particles, &world.sparks.particles, &world.dust.particles})
    forEachField(*particles, [&](const auto& field) {
      if (field.size() != particles->size()) reader.refuse("holds particles of different counts");
    });
}

}  // namespace brisance
