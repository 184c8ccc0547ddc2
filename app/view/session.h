// A session owns a simulation that people look at and change. One thread runs it: it steps, draws and
// encodes. Others say what the pages ask for, and take away what is to be sent.
//
// A page says lines of text, a word and its arguments:
//
//   play 0|1            step N               speed N (steps a frame, 1..1000)      restart
//   back STEP           to this step again; what came later is forgotten
//   camera AZIMUTH ELEVATION DISTANCE X Y Z  home                  size WIDTH HEIGHT
//   best                                     change KEY NUMBER ... (see change.h)  pick X Y
//   save checkpoint|journal|scene                exact 0|1 (frames are wanted)         textures HELD
//   (painters.h)
//
//   film 0|1            stops it, or makes one up to this step, with a frame for each of the page's
//   cells none|COLOURS [AXIS AT]             cells in false colours, cut open (cells_words.h)
//
//   hands               asks for them        give (them to who asked)
//
// It gets frames, files, and answers of one line of JSON with a "type". A line that is wrong gets a
// "refused", and changes nothing.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/view/client.h"
#include "app/view/film.h"
#include "app/view/hands.h"
#include "app/view/painters.h"
#include "app/view/past.h"
#include "library/journal/journal.h"
#include "voxmelt/voxmelt.h"

namespace voxmelt::view {

// Holds what a page gets. Frames, textures and files are binary: the length of a header in four bytes,
// little-endian, the header in JSON, and the picture, PNG or JPEG, or what the file holds.
struct Message {
  enum class Kind { text, frame, textures, file };
  std::string bytes;
  Kind kind = Kind::text;
};
using MessagePtr = std::shared_ptr<const Message>;

// Sends to one page, or to all of them if there is no client. It may be called by the session's thread only.
using Send = std::function<void(std::optional<Client>, const MessagePtr&)>;

class Session {
 public:
  // `open` gives the simulation at its first state, or that of a checkpoint, if a file is named.
  using Open = std::function<Simulation(const std::filesystem::path& checkpoint)>;
  Session(Open open, std::string scene, Send send);

  // Before run(): changes of a journal come by themselves, and what is changed by hand is recorded.
  void follow(journal::Reader journal) { journal_ = std::move(journal); }
  void record(journal::Writer journal) { record_ = std::move(journal); }

  void run();  // until stop()

  // Any thread may call these.
  void stop();
  void say(Client client, std::string line);
  void come(Client client);  // a page has come, and is told everything
  void leave(Client client);

 private:
  struct Order {
    enum class Kind { said, came, left, filmed };
    Client client;
    std::string line;
    Kind kind = Kind::said;
    MessagePtr message{};  // what a film has to tell
  };
  struct Milliseconds {
    double step = 0, draw = 0, encode = 0;
  };

  void put(Order order);
  bool wait();  // for something to do; false after stop()
  void obey(const Order& order);
  void obey(Client client, std::string_view word, std::string_view rest);
  void look(const std::vector<double>& camera);
  void show_cells(std::string_view text);
  void change(std::string_view text);
  void restart();
  void go_back(std::uint32_t step);
  void cut_at(std::uint32_t step);
  void write_down(const journal::Change& change);
  void step(std::uint32_t count);
  void tell_hands();
  void tell_books();
  void show();  // to all pages, by their painters
  void draw();
  void send_textures();
  bool moving() const { return playing_ || single_ > 0; }
  std::string header(const char* type, Quality quality, bool exact) const;
  void tell_world(std::optional<Client> client);
  void tell(std::optional<Client> client, std::string text);
  void pick(Client client, int x, int y);
  void save(Client client, std::string_view what);
  std::string scene_with_changes() const;
  void film(Client client, bool begin);
  Picture picture(Quality quality) const;

  const Open open_;
  Simulation simulation_;
  const std::uint32_t first_;             // steps done at the beginning
  const std::string scene_, scene_text_;  // its name, and all that it says
  const Send send_;
  std::optional<journal::Reader> journal_;
  std::optional<journal::Writer> record_;
  std::vector<journal::Line> changes_;  // all since the beginning
  Past past_{std::size_t{256} << 20};

  bool playing_ = false;
  std::uint32_t speed_ = 3, single_ = 0;  // steps a frame; steps that are still asked for
  int width_ = 640, height_ = 480;
  std::optional<Camera> camera_;
  std::optional<CellView> cells_;  // if the picture is one of cells
  Painters painters_;
  Hands hands_;
  bool stale_ = true;  // the last frame shows something else
  Quality drawn_ = Quality::fast;
  bool best_ = false;  // the best picture was asked for
  Milliseconds last_;
  std::chrono::steady_clock::time_point last_books_{};

  std::mutex mutex_;  // of what follows
  std::condition_variable something_;
  std::vector<Order> orders_;
  std::stop_source stop_;  // steps and pictures end by it, too

  Client film_for_ = 0;
  std::optional<Film> film_;  // last: its thread puts orders
};

}  // namespace voxmelt::view
