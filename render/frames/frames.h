// The pictures of a run become numbered PNG files, a contact sheet and a film.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/frames/film_writer.h"
#include "render/frames/sheet_frames.h"
#include "render/frames/work_line.h"
#include "render/image/image.h"

namespace voxmelt::render {

class Frames {
 public:
  struct Plan {
    std::size_t count = 0;                // frames that are planned; fewer are no error
    std::size_t frame_bytes = 0;          // bytes of a picture in memory; few large ones may wait
    int threads = 1;                      // with one, all work is done in turn; with more, beside the caller
    int frames_per_second = 12;           // of the film
    bool film = true;                     // without, none is made
    FilmKind kind = FilmKind::automatic;  // of the film
    std::function<bool()> stop{};         // says that the film should not be waited for; may be empty
  };

  // Writes folder/frames/frame_00000.png and so on, folder/contact_sheet.png, and
  // folder/film.mp4 or folder/film.webp. No byte depends on the number of threads.
  Frames(std::filesystem::path folder, const Plan& plan);

  // Adds a frame. All frames have one size. The call waits if encoder or film are far behind. It throws what
  // stopped an earlier frame.
  void add(Image image, std::string label);

  // Keeps the next frame, which an earlier part of the run has written. Sheet and film read it from its file.
  void keep(std::string label);

  // Waits until every frame's file is written. Throws what stopped one.
  void settle() { files_.wait(); }

  // Throws what stopped a frame.
  void check() { files_.check(); }

  // Waits for all frames, and makes the sheet and the film.
  FilmMade finish();

  static std::string file_name(std::size_t frame);  // frame_00000.png
  std::size_t count() const { return labels_.size(); }
  // Returns the wall-clock time spent in files and the sheet, summed over threads. It is valid after
  // finish().
  double encode_seconds() const { return encode_seconds_; }

 private:
  struct Frame {
    std::size_t number = 0;
    std::shared_ptr<const Image> image;  // null if it is in its file
  };
  std::filesystem::path file_of(std::size_t frame) const;
  void write_file(const Frame& frame);

  std::filesystem::path folder_;
  bool has_film_;
  std::vector<std::string> labels_;
  SheetFrames sheet_;
  FilmWriter video_;
  std::mutex mutex_;
  double encode_seconds_ = 0;
  // These come last, because their threads use all of the above.
  WorkLine<Frame> film_, files_;
};

}  // namespace voxmelt::render
