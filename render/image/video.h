// MP4 files are made by the `ffmpeg` program, if it is installed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/image/child.h"
#include "render/image/image.h"

namespace voxmelt::render {

// Hands frames to ffmpeg as they come. It makes an H.264 film, or an MPEG-4 one if H.264 is missing. A
// missing film is worth a message, not the end of a run. So nothing here throws, and frames after a problem
// are ignored.
class VideoWriter {
 public:
  // A film is given up when patience with ffmpeg is lost.
  VideoWriter(std::filesystem::path file, int frames_per_second, Patience patience = {});
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;
  ~VideoWriter();  // without finish() there is no film, and nothing is left

  // Adds a frame. All frames have one size. Odd ones lose a row or column, because yuv420p wants even sides.
  void add(const Image& frame);

  // Tells that ffmpeg takes no more frames, though close() was not called.
  bool gave_up() const { return begun_ && to_ffmpeg_ < 0; }

  // Tells ffmpeg that no more frames come. It may need a while to end.
  void close();

  // Renames the film into its place. If there is none, the call returns the file's name and the reason, after
  // the words "no film: ".
  std::optional<std::string> finish();

 private:
  void start(int width, int height);
  void wait_for_room();

  std::filesystem::path file_, beside_;
  int frames_per_second_;
  Patience patience_;
  int to_ffmpeg_ = -1;  // a socket
  Child ffmpeg_;
  bool begun_ = false;
  std::string problem_;
};

// Tells whether there is an `ffmpeg` on the PATH.
bool ffmpeg_found();

}  // namespace voxmelt::render
