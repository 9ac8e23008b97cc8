// A run as the player asks for it: what it is, its pieces, and moment by moment. docs/player.md has the formats.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "frame/run_directory.h"
#include "frame/surface_look.h"
#include "view/compact_gas.h"

namespace brisance {

/// What the player is told of the scene.
struct PlayerScene {
  std::string title, version;
  double fps = 24;       ///< [1/s] of film
  double timeScale = 1;  ///< simulated seconds per second of film
  int frames = 1;        ///< that the film will have
  RenderSettings render;
  SurfaceLooks looks;
};

/// Answers may be asked for by several threads, also while another process goes on with the run.
class PlayerRun {
 public:
  PlayerRun(std::filesystem::path run, PlayerScene scene);

  /// Frames 1 .. N are there: N.
  int lastFrame() const;
  /// What tells a frame from one of the same number in a run that took this one's place: of its files' contents. Empty:
  /// not there.
  std::string version(int frame) const;
  /// JSON: how many frames are there, of how many, and their versions.
  std::string state() const;
  /// JSON: the film's times, light and camera, the gas' optics, the bodies in the order of the poses.
  std::string description() const;
  /// Binary glTF of all bodies at rest, with their looks.
  std::string pieces() const;
  /// Binary glTF of the bodies that took another shape in a frame.
  std::string shapes(int frame) const;
  /// A frame's poses, gas, particles and report: a packed moment file.
  std::string moment(int frame) const;
  /// The names of its files, as the manifest has them.
  bool knowsFile(const std::string& name) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  struct Look;
  std::shared_ptr<const Look> look() const;
  std::string packed(const Frame& frame) const;
  std::string packed(const Frame& frame, int cells) const;
  std::string glb(const std::vector<FrameBody>& bodies) const;

  std::filesystem::path path_;
  PlayerScene scene_;
  BlackbodyColours heat_;
  HeatScale scale_;
  mutable std::mutex guard_;
  mutable std::shared_ptr<const Look> look_;
};

}  // namespace brisance
