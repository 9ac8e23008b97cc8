#include "particles/particle_set.h"

#include <cstring>

namespace brisance {

void append(ParticleSet& p, const NewParticle& particle) {
  p.id.push_back(p.nextId++);
  p.position.push_back(particle.position);
  p.velocity.push_back(particle.velocity);
  p.mass.push_back(particle.mass);
  p.temperature.push_back(particle.temperature);
  p.sootMass.push_back(0);
  p.kind.push_back(particle.kind);
  p.ignited.push_back(particle.ignited);
  p.madeSoot.push_back(0);
}

std::size_t appendBlank(ParticleSet& particles, std::size_t count) {
  const std::size_t first = particles.size();
  forEachField(particles, [&](auto& field) { field.resize(first + count); });
  for (std::size_t n = first; n < first + count; ++n) particles.id[n] = particles.nextId++;
  return first;
}

namespace {
/// Particles [first, end) that stay, moved to `to`.
struct KeptRun {
  std::size_t first, end, to;
};

/// What stays and has to move. Long runs of bytes are searched by the C library, eight and more at once.
std::vector<KeptRun> keptRuns(const std::vector<std::uint8_t>& gone, std::size_t& kept) {
  std::vector<KeptRun> runs;
  const auto find = [&](std::size_t from, std::uint8_t value) {
    const void* at = from < gone.size() ? std::memchr(gone.data() + from, value, gone.size() - from) : nullptr;
    return at ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(at) - gone.data()) : gone.size();
  };
  kept = find(0, 1);
  for (std::size_t first = find(kept, 0); first < gone.size();) {
    const std::size_t end = find(first, 1);
    runs.push_back({first, end, kept});
    kept += end - first;
    first = find(end, 0);
  }
  return runs;
}
}  // namespace

void removeFlagged(ParticleSet& particles, const std::vector<std::uint8_t>& gone) {
  std::size_t kept = 0;
  const std::vector<KeptRun> runs = keptRuns(gone, kept);
  if (kept == gone.size()) return;
  forEachField(particles, [&](auto& field) {
    for (const KeptRun& run : runs)
      std::copy(field.begin() + static_cast<std::ptrdiff_t>(run.first),
                field.begin() + static_cast<std::ptrdiff_t>(run.end),
                field.begin() + static_cast<std::ptrdiff_t>(run.to));
    field.resize(kept);
  });
}

}  // namespace brisance
