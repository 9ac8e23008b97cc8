// The film from the pictures.
#pragma once

#include "frame/run_directory.h"
#include "scene/scene_file.h"

namespace brisance {

struct Film {
  int frames = 0;   ///< counted in the finished file
  FileRecord file;  ///< of film.mp4
};

/// Encodes RUN/images/frame.0001.png, ... into RUN/film.mp4 (H.264, yuv420p, playable while it loads), counts its
/// frames and records it in the manifest. Throws InputError when there is no picture or a gap in their sequence,
/// Error(failed) when ffmpeg or ffprobe is missing, fails, or leaves frames out. A film that was there before is kept
/// until the new one is whole.
Film encodeFilm(RunDirectory& run, const FilmSettings& settings);

}  // namespace brisance
