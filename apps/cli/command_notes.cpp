#include "command_notes.h"

#include <map>

namespace brisance {

std::vector<Note> examplesOf(const std::string& command) {
  static const std::map<std::string, std::vector<Note>> examples{
      {"run",
       {{"brisance run scenes/window.toml", "the film of a scene, in runs/window"},
        {"brisance run scenes/window.toml -o runs/draft --set scene.quality=draft", "the same, small and fast"}}},
      {"check", {{"brisance check scenes/window.toml", "what it would cost"}}},
      {"simulate",
       {{"brisance simulate scenes/window.toml -o runs/window", "all frames, without pictures"},
        {"brisance simulate scenes/window.toml -o runs/window --resume", "go on after an interruption"}}},
      {"render",
       {{"brisance render runs/window --frames 20-40:10 --size 960x720", "three larger pictures"},
        {"brisance render runs/window --skip-existing", "those that are missing"}}},
      {"encode", {{"brisance encode runs/window", "runs/window/film.mp4"}}},
      {"fracture",
       {{"brisance fracture toy.obj --method curvature --pieces 8 -o toy.glb", "where it is weakest"},
        {"brisance fracture toy.obj --solid --method voronoi --pieces 40 -o toy.glb", "solids that fill it exactly"}}},
      {"export",
       {{"brisance export runs/window --to gltf -o window.glb", "moving bodies"},
        {"brisance export runs/window --to vdb --profile blender -o gas", "gas for Blender"}}},
      {"farm",
       {{"brisance farm runs/window --engine slurm --scene scenes/window.toml --chunk 10", "a film on many machines"},
        {"brisance farm runs/window --engine slurm", "what is still missing"}}},
      {"view", {{"brisance view runs/window", "prints the address to open"}}},
      {"info", {{"brisance info runs/window", "frames, pictures, film, size"}}},
      {"verify", {{"brisance verify runs/window", "every file as it was written?"}}},
      {"reference",
       {{"brisance reference parameters", "every key of the scene file"},
        {"brisance reference completion-bash > ~/.local/share/bash-completion/completions/brisance",
         "completion in bash"}}}};
  const auto found = examples.find(command);
  return found == examples.end() ? std::vector<Note>{} : found->second;
}

const std::vector<Note>& exitCodeNotes() {
  static const std::vector<Note> notes{
      {"0", "done"},
      {"1", "failed while working: a tool that is missing, a run that another process works in, a bug"},
      {"2", "the command line or the scene is wrong"},
      {"3", "an input file, or a file of a run, is damaged"},
      {"4", "no room: disk full, directory not writable, not enough memory"},
      {"5", "the simulation left its stable range"},
      {"130", "interrupted by Ctrl-C; what was typed can be continued, and the command for it is printed"},
      {"143", "interrupted by SIGTERM, likewise"}};
  return notes;
}

const std::vector<Note>& environmentNotes() {
  static const std::vector<Note> notes{{"NO_COLOR", "where it is set and not empty, progress has no colour"}};
  return notes;
}

const std::vector<Note>& fileNotes() {
  static const std::vector<Note> notes{
      {"SCENE.toml", "the scene: what burns, breaks, is seen; `brisance reference parameters` lists its keys"},
      {"RUN/", "the directory of a run, with copies of all its inputs"},
      {"RUN/scene.toml", "the scene as run, every default written out"},
      {"RUN/manifest.json", "every finished file with its size and hash"},
      {"RUN/gas/gas.0001.vdb", "gas of frame 1, as OpenVDB"},
      {"RUN/bodies/, RUN/particles/", "poses of the bodies, and particles, of every frame"},
      {"RUN/images/frame.0001.png, .exr", "pictures"},
      {"RUN/film.mp4", "the film"}};
  return notes;
}

}  // namespace brisance
