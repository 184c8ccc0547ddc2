// What becomes of the pictures of a run: numbered PNG files, a contact sheet and a film.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/frames/sheet_frames.h"
#include "render/frames/work_line.h"
#include "render/image/image.h"
#include "render/image/video.h"

namespace voxmelt::render {

class Frames {
 public:
  struct Plan {
    std::size_t count = 0;        // of frames; fewer are no error
    std::size_t frame_bytes = 0;  // of one picture in memory: large ones do not wait in numbers
    int threads = 1;              // with one all is done in turn, with more beside the caller
    int frames_per_second = 12;   // of the film
  };

  // Into folder/frames/frame_00000.png, ..., folder/contact_sheet.png and folder/film.mp4. No byte depends on
  // the number of threads.
  Frames(std::filesystem::path folder, const Plan& plan);

  // Frames have one size. This waits if encoder or film are far behind. Throws what stopped an earlier frame.
  void add(Image image, std::string label);

  // The next frame is there already, from the part of the run before: sheet and film get it from its file.
  void keep(std::string label);

  // Waits until every frame's file is written. Throws what stopped one.
  void settle() { files_.wait(); }

  // Throws what stopped a frame.
  void check() { files_.check(); }

  // Waits for all, and makes the sheet and the film. Returns why there is no film, or nothing.
  std::string finish();

  static std::string file_name(std::size_t frame);  // frame_00000.png
  std::size_t count() const { return labels_.size(); }
  // Wall-clock time spent in files and the sheet, summed over threads. After finish().
  double encode_seconds() const { return encode_seconds_; }

 private:
  struct Frame {
    std::size_t number = 0;
    std::shared_ptr<const Image> image;  // null: it is in its file
  };
  std::filesystem::path file_of(std::size_t frame) const;
  void write_file(const Frame& frame);

  std::filesystem::path folder_;
  std::vector<std::string> labels_;
  SheetFrames sheet_;
  VideoWriter video_;
  std::mutex mutex_;
  double encode_seconds_ = 0;
  // Last, because their threads use all of the above.
  WorkLine<Frame> film_, files_;
};

}  // namespace voxmelt::render
