#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "base/check.h"
#include "command_notes.h"
#include "command_tree.h"

namespace brisance {

namespace {

constexpr const char* whatItDoes = "One scene file in; a film of an exploding, shattering scene out.";

/// What CLI11 writes into while it reads.
struct RawOptions {
  Options options;
  RawFractureOptions fracture;
  const CLI::App* fractureCommand = nullptr;
  std::string frames, size, format, profile;
  double samples = 0;
  bool overwrite = false, resume = false;
  bool redraws = false;  ///< pictures that are there: the default of `render`
};

CLI::App* addCommand(CLI::App& app, RawOptions& raw, const std::string& name, const std::string& what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->callback([&raw, name] { raw.options.command = name; });
  command->add_flag("--json", raw.options.json, "one JSON object on standard output, and nothing else there");
  command->add_flag("--quiet", raw.options.quiet, "no progress");
  return command;
}

void addPath(CLI::App* command, RawOptions& raw, const std::string& name, const std::string& what) {
  command->add_option(name, raw.options.path, what)->required()->option_text(" ");
}

void addThreads(CLI::App* command, RawOptions& raw) {
  command->add_option("--threads", raw.options.threads, "how many threads; 0: one per core")
      ->check(CLI::Range(0, 4096))
      ->option_text("N");
}

void addWorkOptions(CLI::App* command, RawOptions& raw) {
  addThreads(command, raw);
  command
      ->add_option("--set", raw.options.overrides,
                   "any key of the scene: --set explosion.burn_rate=0.3; may be repeated")
      ->option_text("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

void addRunOptions(CLI::App* command, RawOptions& raw) {
  CLI::Option* overwrite = command->add_flag("--overwrite", raw.overwrite, "remove the run that is there");
  CLI::Option* resume = command->add_flag("--resume", raw.resume, "continue the run that is there, or start it");
  overwrite->excludes(resume);
}

void addFrames(CLI::App* command, RawOptions& raw, const std::string& shape, const std::string& what) {
  command->add_option("--frames", raw.frames, what)->option_text(shape);
}

CLI::Option* skipping(CLI::App* command, RawOptions& raw, const std::string& names) {
  return command->add_flag(names, raw.options.skipExisting, "leave pictures that are whole as they are");
}

void addPictureOptions(CLI::App* command, RawOptions& raw) {
  command->add_option("--size", raw.size, "of the pictures, instead of the scene's")->option_text("WxH");
  command->add_option("--samples", raw.samples, "N x N rays for a pixel, instead of the scene's; 1.5: 2.25 in the mean")
      ->check(CLI::PositiveNumber)
      ->option_text("N");
}

void addSceneCommands(CLI::App& app, RawOptions& raw) {
  CLI::App* run = addCommand(app, raw, "run", "simulate, render and encode a scene: the film, in one go");
  addPath(run, raw, "SCENE", "the scene file");
  run->add_option("-o,--output", raw.options.output, "the run directory; runs/SCENE by default")->option_text("RUN");
  addFrames(run, raw, "A-B[:S]", "simulate to B, pictures of these; a film only of 1-B");
  addPictureOptions(run, raw);
  skipping(run, raw, "--skip-existing");
  addWorkOptions(run, raw);
  addRunOptions(run, raw);

  CLI::App* check = addCommand(app, raw, "check", "read and check a scene; print the cost ahead");
  addPath(check, raw, "SCENE", "the scene file");
  check->add_option("-o,--output", raw.options.output, "where the run would be made")->option_text("RUN");
  addWorkOptions(check, raw);

  CLI::App* simulate = addCommand(app, raw, "simulate", "bodies, gas and particles over time, without pictures");
  addPath(simulate, raw, "SCENE", "the scene file");
  simulate->add_option("-o,--output", raw.options.output, "the run directory")->required()->option_text("RUN");
  addFrames(simulate, raw, "1-B", "up to this frame");
  addWorkOptions(simulate, raw);
  addRunOptions(simulate, raw);
}

void addPictureCommands(CLI::App& app, RawOptions& raw) {
  CLI::App* render = addCommand(app, raw, "render", "pictures of a run: any frames, in any order");
  addPath(render, raw, "RUN", "the run directory");
  addFrames(render, raw, "A-B[:S]", "only these frames, from 1");
  addPictureOptions(render, raw);
  CLI::Option* skip = skipping(render, raw, "--skip-existing,--resume");
  render->add_flag("--overwrite", raw.redraws, "draw pictures anew that are there, as it does by default")
      ->excludes(skip);
  addWorkOptions(render, raw);

  CLI::App* encode = addCommand(app, raw, "encode", "the film from the pictures of a run");
  addPath(encode, raw, "RUN", "the run directory");
  addWorkOptions(encode, raw);
}

void addFractureCommand(CLI::App& app, RawOptions& raw) {
  CLI::App* fracture = addCommand(app, raw, "fracture", "break a mesh, or the bodies of a scene, into pieces");
  addPath(fracture, raw, "MESH", "OBJ, PLY, STL or glTF; or a scene file");
  addFractureOptions(*fracture, raw.fracture);
  fracture->add_option("--size", raw.size, "of the picture; 960x720 where not given")->option_text("WxH");
  fracture->add_flag("--overwrite", raw.overwrite, "replace files that are there");
  addWorkOptions(fracture, raw);
  raw.fractureCommand = fracture;
}

constexpr std::pair<const char*, ExportFormat> exportFormats[] = {
    {"gltf", ExportFormat::gltf}, {"usd", ExportFormat::usd},
    {"vdb", ExportFormat::vdb},   {"vdb-points", ExportFormat::vdbPoints},
    {"obj", ExportFormat::obj},   {"html", ExportFormat::html}};

void addExportCommand(CLI::App& app, RawOptions& raw) {
  CLI::App* command = addCommand(app, raw, "export", "a run for other tools: moving bodies, gas, particles");
  addPath(command, raw, "RUN", "the run directory");
  command
      ->add_option("--to", raw.format,
                   "gltf: bodies, moving, one .glb; usd: bodies and gas, one .usda; vdb: a folder of gas files; "
                   "vdb-points: a folder with the particles of each frame; "
                   "obj: a folder with the bodies of each frame; html: a player in one file")
      ->required()
      ->check(CLI::IsMember({"gltf", "usd", "vdb", "vdb-points", "obj", "html"}))
      ->option_text("NAME");
  command->add_option("-o,--output", raw.options.output, "the file or folder to make")->required()->option_text("PATH");
  addFrames(command, raw, "A-B[:S]", "only these frames, from 1; all that are there where not given");
  command->add_option("--profile", raw.profile, "of vdb: blender, z up as an imported glTF lies, and its grid names")
      ->check(CLI::IsMember({"blender"}))
      ->option_text("NAME");
  command->add_flag("--overwrite", raw.overwrite, "replace what an earlier export made");
  addThreads(command, raw);
}

void finishExport(const RawOptions& raw, Options& options) {
  for (const auto& [name, format] : exportFormats)
    if (raw.format == name) options.format = format;
  if (raw.profile.empty()) return;
  if (options.format != ExportFormat::vdb)
    throw InputError(fmt::format("brisance: --profile: belongs to --to vdb; {} files are alike for all", raw.format));
  options.profile = ExportProfile::blender;
}

void addEngineOptions(CLI::App* command, FarmOptions& farm) {
  command->add_option("--engine", farm.engine, "slurm; or local: processes on this machine, one after the other")
      ->required()
      ->check(CLI::IsMember({"slurm", "local"}))
      ->option_text("NAME");
  const auto number = [&](const char* name, int& value, const char* what) {
    command->add_option(name, value, what)->check(CLI::Range(1, 1000000))->option_text("N");
  };
  number("--chunk", farm.chunk, "pictures of a task at most; 10 where not given");
  number("--cores", farm.cores, "for each task");
  number("--at-once", farm.atOnce, "tasks at the same time at most");
  number("--rounds", farm.rounds, "how often in all pictures that are missing are tried; 3 where not given");
  command->add_option("--partition", farm.partition, "of slurm")->option_text("NAME");
  command->add_option("--submit", farm.submitted, "of slurm: an option for sbatch, like --submit=--mem=8G; repeatable")
      ->option_text("OPTION")
      ->take_all()
      ->allow_extra_args(false);
}

void addFarmCommand(CLI::App& app, RawOptions& raw) {
  FarmOptions& farm = raw.options.farm;
  CLI::App* command = addCommand(app, raw, "farm", "what a film still lacks, as jobs of many machines");
  addPath(command, raw, "RUN", "the run directory, where all of them see it");
  command->add_option("--scene", farm.scene, "the scene file, where the run is yet to be made")->option_text("SCENE");
  addEngineOptions(command, farm);
  command->add_flag("--dry-run", farm.dryRun, "print the jobs, and do nothing");
  command->add_flag(
      "--check", farm.check,
      "what the farm calls itself after the pictures: fails where some are missing, and submits them again");
  command->add_option("--round", farm.round, "of --check: which it is")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  command->add_option("--size", raw.size, "of the pictures, instead of the scene's")->option_text("WxH");
  command->add_option("--samples", raw.samples, "N x N rays for a pixel, instead of the scene's; 1.5: 2.25 in the mean")
      ->check(CLI::PositiveNumber)
      ->option_text("N");
  addWorkOptions(command, raw);
  addRunOptions(command, raw);
}

void addLookingCommands(CLI::App& app, RawOptions& raw) {
  CLI::App* view = addCommand(app, raw, "view", "a player of a run in the browser, for this machine alone");
  addPath(view, raw, "RUN", "the run directory; it may still be going on");
  view->add_option("--port", raw.options.port, "on which it listens; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->option_text("P");
  addThreads(view, raw);

  CLI::App* info = addCommand(app, raw, "info", "what a run, a scene or a mesh holds");
  addPath(info, raw, "PATH", "a run directory, a scene file or a mesh");
  CLI::App* verify = addCommand(app, raw, "verify", "every file of a run against the hashes of its manifest");
  addPath(verify, raw, "RUN", "the run directory");
}

void addReferenceCommand(CLI::App& app, RawOptions& raw) {
  CLI::App* reference = addCommand(app, raw, "reference", "print a page about the scene file or the commands");
  reference
      ->add_option("PAGE", raw.options.page,
                   "keys of the scene file: parameters for people, schema for editors; commands: commands in Markdown, "
                   "man for man, completion-... for shells")
      ->required()
      ->check(CLI::IsMember(
          {"parameters", "schema", "commands", "man", "completion-bash", "completion-zsh", "completion-fish"}))
      ->option_text(" ");
  reference->add_option("COMMAND", raw.options.pageOf, "of man: the command that the page is about")->option_text(" ");
}

void addExamples(CLI::App& command) {
  std::string lines;
  for (const Note& example : examplesOf(command.get_name())) lines += "\n  " + example.name;
  if (!lines.empty()) command.footer("Examples:" + lines);
}

/// Everything that can be typed.
void addCommands(CLI::App& app, RawOptions& raw) {
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("brisance ") + BRISANCE_VERSION, "print the version and end");
  app.set_help_flag("-h,--help", "print this and end");
  addSceneCommands(app, raw);
  addPictureCommands(app, raw);
  addFractureCommand(app, raw);
  addExportCommand(app, raw);
  addFarmCommand(app, raw);
  addLookingCommands(app, raw);
  addReferenceCommand(app, raw);
  for (CLI::App* command : app.get_subcommands(nullptr)) addExamples(*command);
}

/// The first word that is no option; CLI11 itself would only say that a command is missing.
void refuseUnknownCommand(const CLI::App& app, int count, const char* const* arguments) {
  if (count < 2 || arguments[1][0] == '-') return;
  std::string known;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_name() == arguments[1]) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw InputError(fmt::format("brisance: {}: unknown command; must be one of {}", arguments[1], known));
}

std::string inOneLine(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

Options finished(RawOptions raw) {
  Options options = std::move(raw.options);
  if (!raw.frames.empty()) options.frames = parseFrameRange(raw.frames);
  if (!raw.size.empty()) options.size = parsePictureSize(raw.size);
  if (options.command == "fracture") options.fracture = finished(raw.fracture, *raw.fractureCommand);
  if (options.command == "export") finishExport(raw, options);
  if (raw.samples > 0) options.samples = raw.samples;
  if (raw.overwrite) options.existing = ExistingRun::overwrite;
  if (raw.resume) options.existing = ExistingRun::resume;
  return options;
}

}  // namespace

DescribedProgram describedProgram() {
  CLI::App app(whatItDoes, "brisance");
  RawOptions raw;
  addCommands(app, raw);
  return describe(app);
}

CommandLine parseCommandLine(int count, const char* const* arguments) {
  CLI::App app(whatItDoes, "brisance");
  RawOptions raw;
  addCommands(app, raw);
  refuseUnknownCommand(app, count, arguments);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& trouble) {
    if (trouble.get_exit_code() == 0) return {app.exit(trouble), {}};
    throw InputError(fmt::format("brisance: {} (brisance --help lists what there is)", inOneLine(trouble.what())));
  }
  raw.options.arguments.assign(arguments, arguments + count);
  return {std::nullopt, finished(std::move(raw))};
}

}  // namespace brisance
