// What can be typed behind `brisance`, as plain values.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "command_tree.h"
#include "fracture_options.h"

namespace brisance {

/// Frames first, first + step, ... up to last; all count from 1.
struct FrameRange {
  int first = 1;
  int last = 0;  ///< 0: to the end
  int step = 1;
};

/// "A-B:S", "A-B" or "A". Throws InputError naming --frames.
FrameRange parseFrameRange(const std::string& text);

struct PictureSize {
  int width = 0, height = 0;  ///< [pixels]
};

/// "WxH". Throws InputError naming --size.
PictureSize parsePictureSize(const std::string& text);

enum class ExportFormat { gltf, usd, vdb, vdbPoints, obj, html };
/// Whose habits the files follow.
enum class ExportProfile { ours, blender };

/// What may happen to a run that exists.
enum class ExistingRun { refuse, overwrite, resume };

/// What can be typed behind `brisance farm`.
struct FarmOptions {
  std::string engine;                  ///< "slurm", "local"
  std::filesystem::path scene;         ///< of which the run is made; empty: the run is there
  int chunk = 10;                      ///< frames of a task
  int cores = 0;                       ///< for each task; 0: the engine's choice
  int atOnce = 0;                      ///< tasks at the same time; 0: the engine's choice
  std::string partition;               ///< empty: the engine's choice
  std::vector<std::string> submitted;  ///< handed on to the engine
  int rounds = 3;                      ///< of making up for what is missing
  int round = 1;
  bool check = false;   ///< only what comes after the pictures: is anything missing?
  bool dryRun = false;  ///< do nothing, and say what would be done
};

struct Options {
  std::vector<std::string> arguments;  ///< as typed, the program's name first
  std::string command;
  std::filesystem::path path;                  ///< SCENE, RUN, MESH or PATH
  std::filesystem::path output;                ///< empty: not given
  std::string page;                            ///< of `reference`
  std::string pageOf;                          ///< of its page `man`: a command; empty: the program
  std::optional<FrameRange> frames;            ///< absent: all
  std::optional<PictureSize> size;             ///< absent: the scene's
  std::optional<double> samples;               ///< absent: the scene's
  std::vector<std::string> overrides;          ///< "key.path=value"
  int threads = 0;                             ///< 0: all cores
  ExistingRun existing = ExistingRun::refuse;  ///< --overwrite, --resume
  FractureOptions fracture;
  FarmOptions farm;
  ExportFormat format = ExportFormat::gltf;  ///< of `export`
  ExportProfile profile = ExportProfile::ours;
  int port = 0;  ///< of `view`; 0: any that is free
  bool skipExisting = false;
  bool json = false;
  bool quiet = false;
};

/// What is left to do once the command line was read: exit with this code, or go on with the options.
struct CommandLine {
  std::optional<int> exitCode;  ///< --help and --version were answered already
  Options options;
};

/// Throws InputError with one line for anything that does not belong there.
CommandLine parseCommandLine(int count, const char* const* arguments);

/// All that can be typed.
DescribedProgram describedProgram();

}  // namespace brisance
