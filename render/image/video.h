// MP4 files, made by the `ffmpeg` program where it is installed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace voxmelt::render {

// Joins numbered pictures ("frames/frame_%05d.png", counted from `first`) to an H.264 film, or to an MPEG-4
// one where H.264 is missing. Written beside and renamed. Returns nothing when the film is there and the
// reason when it is not: a missing film is worth a message, not the end of a run.
std::optional<std::string> write_video(const std::filesystem::path& file, const std::string& frame_pattern,
                                       int first, int frames_per_second);

// Is there an `ffmpeg` on the PATH?
bool ffmpeg_found();

}  // namespace voxmelt::render
