#include "frame/particle_file.h"

#include <charconv>
#include <cstring>

#include "base/check.h"
#include "base/durable_file.h"

namespace brisance {

namespace {

/// One vertex as the file holds it, without padding.
struct [[gnu::packed]] PlyVertex {
  float x, y, z, vx, vy, vz, mass, temperature;
  std::uint8_t kind;
};

constexpr std::string_view countLead = "ply\nformat binary_little_endian 1.0\nelement vertex ";

std::string headerFor(std::size_t count) {
  std::string header = fmt::format("{}{}\n", countLead, count);
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz", "mass", "temperature"})
    header += fmt::format("property float {}\n", name);
  return header + "property uchar kind\nend_header\n";
}

PlyVertex vertexOf(const FrameParticles& p, std::size_t n) {
  return {p.position[n].x, p.position[n].y, p.position[n].z,  p.velocity[n].x, p.velocity[n].y,
          p.velocity[n].z, p.mass[n],       p.temperature[n], p.kind[n]};
}

void addVertex(FrameParticles& p, const PlyVertex& v) {
  p.position.emplace_back(v.x, v.y, v.z);
  p.velocity.emplace_back(v.vx, v.vy, v.vz);
  p.mass.push_back(v.mass);
  p.temperature.push_back(v.temperature);
  p.kind.push_back(v.kind);
}

/// The count in the header; the header's other bytes are compared as a whole afterwards.
std::size_t countIn(const std::string& bytes) {
  std::size_t count = 0;
  if (bytes.starts_with(countLead))
    std::from_chars(bytes.data() + countLead.size(), bytes.data() + bytes.size(), count);
  return std::min(count, bytes.size() / sizeof(PlyVertex));
}

}  // namespace

std::string particlesToPly(const FrameParticles& particles) {
  const std::size_t count = particles.position.size();
  CHECK(particles.velocity.size() == count && particles.mass.size() == count && particles.temperature.size() == count &&
            particles.kind.size() == count,
        "{} particles", count);
  std::string bytes = headerFor(count);
  bytes.reserve(bytes.size() + count * sizeof(PlyVertex));
  for (std::size_t n = 0; n < count; ++n) {
    const PlyVertex vertex = vertexOf(particles, n);
    bytes.append(reinterpret_cast<const char*>(&vertex), sizeof vertex);
  }
  return bytes;
}

FrameParticles particlesFromPly(const std::string& bytes, const std::string& fileName) {
  const std::size_t count = countIn(bytes);
  const std::string header = headerFor(count);
  if (!bytes.starts_with(header) || bytes.size() != header.size() + count * sizeof(PlyVertex))
    throw DamagedFile(fmt::format("{}: is no particle file of this program; simulate this frame again", fileName));
  FrameParticles particles;
  for (std::size_t n = 0; n < count; ++n) {
    PlyVertex vertex;
    std::memcpy(&vertex, bytes.data() + header.size() + n * sizeof vertex, sizeof vertex);
    addVertex(particles, vertex);
  }
  return particles;
}

std::string contentHash(const FrameParticles& particles) {
  ContentHash hash;
  hash.addValues(std::span(particles.position));
  hash.addValues(std::span(particles.velocity));
  hash.addValues(std::span(particles.mass));
  hash.addValues(std::span(particles.temperature));
  hash.addValues(std::span(particles.kind));
  return hash.hex();
}

}  // namespace brisance
