#include "app/view/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/view/books.h"
#include "app/view/cells_words.h"
#include "app/view/encode.h"
#include "app/view/scratch.h"
#include "app/view/texture_message.h"
#include "app/view/world_message.h"

namespace voxmelt::view {
namespace {

using Clock = std::chrono::steady_clock;
using json = nlohmann::ordered_json;

constexpr std::uint32_t kFastest = 1000, kMostSteps = 100'000;
constexpr int kSmallest = 64, kWidest = 3840, kHighest = 2160;
constexpr double kMostVersion = INT32_MAX;
constexpr const char* kFilmIsOver = "over";
constexpr std::size_t kMostOrders = 10'000;  // beyond it pages are not heard

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count() * 1000;
}

// Reads `count` finite numbers, and nothing else.
std::vector<double> numbers(std::string_view text, std::size_t count) {
  const journal::Change read = journal::read_change("x " + std::string(text));
  if (read.numbers.size() != count) throw InputError(fmt::format("error: wants {} numbers", count));
  return read.numbers;
}
int whole(double number, double least, double most) {
  if (!(number >= least && number <= most && number == static_cast<double>(static_cast<long>(number))))
    throw InputError(fmt::format("error: wants a whole number from {} to {}", least, most));
  return static_cast<int>(number);
}

json array_of(const Position& p) { return {p[0], p[1], p[2]}; }

const char* name_of(Quality quality) {
  if (quality == Quality::fast) return "fast";
  return quality == Quality::normal ? "normal" : "best";
}
const char* name_of(Shown shown) {
  constexpr const char* kNames[] = {"solid", "liquid", "obstacle", "ground"};
  return kNames[static_cast<std::size_t>(shown)];
}

MessagePtr binary(Message::Kind kind, const std::string& head, const std::string& body) {
  Message message{{}, kind};
  const auto length = static_cast<std::uint32_t>(head.size());
  for (int i = 0; i < 4; ++i) message.bytes += static_cast<char>(length >> (8 * i) & 0xFF);
  message.bytes += head + body;
  return std::make_shared<const Message>(std::move(message));
}

MessagePtr file_message(const std::string& name, const std::string& bytes) {
  const json head{{"type", "file"}, {"name", name}};
  return binary(Message::Kind::file, head.dump(-1, ' ', true, json::error_handler_t::replace), bytes);
}

}  // namespace

Session::Session(Open open, std::string scene, Send send)
    : open_(std::move(open)),
      simulation_(open_({})),
      first_(simulation_.steps_done()),
      scene_(std::move(scene)),
      scene_text_(simulation_.scene_text()),
      send_(std::move(send)) {}

void Session::stop() {
  const std::lock_guard lock(mutex_);
  stop_.request_stop();
  something_.notify_all();
}

void Session::put(Order order) {
  const std::lock_guard lock(mutex_);
  if (order.kind == Order::Kind::said && orders_.size() >= kMostOrders) return;
  orders_.push_back(std::move(order));
  something_.notify_all();
}

void Session::say(Client client, std::string line) { put({client, std::move(line)}); }
void Session::come(Client client) { put({client, {}, Order::Kind::came}); }
void Session::leave(Client client) { put({client, {}, Order::Kind::left}); }

// Pictures of what moves are fast, those of what rests normal, and the best ones if somebody asks.
bool Session::wait() {
  std::vector<Order> orders;
  {
    std::unique_lock lock(mutex_);
    const bool busy = playing_ || single_ > 0 || stale_ || (best_ && drawn_ != Quality::best);
    if (!busy) something_.wait(lock, [&] { return stop_.stop_requested() || !orders_.empty(); });
    if (stop_.stop_requested()) return false;
    orders.swap(orders_);
  }
  for (const Order& order : orders) obey(order);
  return true;
}

void Session::run() {
  try {
    while (wait()) {
      const std::uint32_t count = playing_ ? speed_ : std::min(single_, speed_);
      if (count > 0) step(count);
      single_ -= std::min(single_, count);
      if (stale_ || (best_ && drawn_ != Quality::best)) show();
    }
  } catch (const Stopped&) {  // while a picture was drawn
  }
}

void Session::obey(const Order& order) {
  if (order.kind == Order::Kind::filmed) {
    send_(order.client, order.message);
    if (order.line == kFilmIsOver) film_.reset();
    return;
  }
  if (order.kind == Order::Kind::left) {
    if (film_ && film_for_ == order.client) film_->stop();
    painters_.leave(order.client);
    hands_.leave(order.client);
    return tell_hands();
  }
  if (order.kind == Order::Kind::came) {
    painters_.come(order.client);
    hands_.come(order.client);
    tell_hands();
    tell_world(order.client);
    stale_ = true;
    return;
  }
  const std::string_view line = order.line;
  const std::size_t space = std::min(line.find(' '), line.size());
  try {
    obey(order.client, line.substr(0, space), line.substr(std::min(space + 1, line.size())));
  } catch (const Error& error) {
    tell(order.client, json{{"type", "refused"}, {"line", order.line}, {"why", error.what()}}.dump(
                           -1, ' ', true, json::error_handler_t::replace));
  }
}

void Session::tell_hands() {
  for (const Client client : hands_.pages())
    tell(client,
         json{{"type", "hands"}, {"yours", hands_.has(client)}, {"asked", hands_.asked(client)}}.dump());
}

void Session::obey(Client client, std::string_view word, std::string_view rest) {
  if (Hands::are_needed(word) && !hands_.has(client))
    throw InputError("error: another page has the hands; `hands` asks for them");
  if (word == "hands" || word == "give") {
    numbers(rest, 0);
    if (word == "hands")
      hands_.ask(client, Clock::now());
    else
      hands_.give();
    tell_hands();
  } else if (word == "play") {
    playing_ = whole(numbers(rest, 1)[0], 0, 1) == 1;
    stale_ = true;
  } else if (word == "step") {
    single_ += static_cast<std::uint32_t>(whole(numbers(rest, 1)[0], 1, kMostSteps));
  } else if (word == "speed") {
    speed_ = static_cast<std::uint32_t>(whole(numbers(rest, 1)[0], 1, kFastest));
  } else if (word == "restart") {
    numbers(rest, 0);
    restart();
  } else if (word == "back") {
    go_back(static_cast<std::uint32_t>(whole(numbers(rest, 1)[0], 0, simulation_.steps_done())));
  } else if (word == "camera") {
    look(numbers(rest, 6));
  } else if (word == "home") {
    numbers(rest, 0);
    camera_.reset();
    stale_ = true;
  } else if (word == "size") {
    const std::vector<double> n = numbers(rest, 2);
    const int width = whole(n[0], kSmallest, kWidest), height = whole(n[1], kSmallest, kHighest);
    width_ = width;
    height_ = height;
    stale_ = true;
  } else if (word == "best") {
    numbers(rest, 0);
    best_ = true;
  } else if (word == "cells") {
    show_cells(rest);
  } else if (word == "exact") {
    painters_.want_exact(client, whole(numbers(rest, 1)[0], 0, 1) == 1);
    stale_ = true;
  } else if (word == "textures") {
    painters_.ask(client, static_cast<std::uint64_t>(whole(numbers(rest, 1)[0], 0, kMostVersion)));
    send_textures();
  } else if (word == "change") {
    change(rest);
  } else if (word == "film") {
    film(client, whole(numbers(rest, 1)[0], 0, 1) == 1);
  } else if (word == "save") {
    save(client, rest);
  } else if (word == "pick") {
    const std::vector<double> n = numbers(rest, 2);
    pick(client, whole(n[0], 0, width_ - 1), whole(n[1], 0, height_ - 1));
  } else {
    throw InputError("error: no such word");
  }
}

void Session::look(const std::vector<double>& n) {
  Camera camera = simulation_.camera(picture(Quality::fast));
  camera.azimuth = n[0];
  camera.elevation = n[1];
  camera.distance = n[2];
  camera.target = {n[3], n[4], n[5]};
  Picture asked = picture(Quality::fast);
  asked.camera = camera;
  (void)simulation_.camera(asked);  // refuses what is out of range
  camera_ = camera;
  stale_ = true;
}

void Session::show_cells(std::string_view text) {
  const std::optional<CellView> cells = read_cells(text);
  if (cells) (void)simulation_.pick_cell(0, 0, *cells, picture(Quality::fast));  // refuses what is wrong
  cells_ = cells;
  stale_ = true;
}

void Session::change(std::string_view text) {
  const journal::Change change = journal::read_change(text);
  journal::WorldOf<Simulation> world(simulation_);
  journal::apply(change, world);
  write_down(change);
  stale_ = true;
  tell_world({});
}

void Session::write_down(const journal::Change& change) {
  changes_.push_back({simulation_.steps_done(), change, {}});
  if (record_) record_->write(simulation_.steps_done(), change);
}

// The film is of this camera, up to this step, with a frame for each of the page's.
void Session::film(Client client, bool begin) {
  if (!begin) {
    if (film_) film_->stop();
    return;
  }
  if (film_) throw InputError("error: a film is being made already");
  const auto tell = [this, client](const Film::Progress& now) {
    Order order{client, now.over ? kFilmIsOver : "", Order::Kind::filmed};
    if (now.film.empty()) {
      json text{{"type", "film"}, {"frames", now.frames}, {"planned", now.planned}, {"over", now.over}};
      text["problem"] = now.problem;
      order.message = std::make_shared<const Message>(
          Message{text.dump(-1, ' ', true, json::error_handler_t::replace), Message::Kind::text});
    } else {
      order.message = file_message(std::filesystem::path(scene_).stem().string() + now.ending, now.film);
    }
    put(std::move(order));
  };
  film_for_ = client;
  film_.emplace(Film::Plan{.open = [open = open_] { return open({}); },
                           .changes = changes_,
                           .first = first_,
                           .last = simulation_.steps_done(),
                           .every = speed_,
                           .picture = picture(Quality::best)},
                tell);
}

// Changes of a journal become those of a scene, [[change]].
std::string Session::scene_with_changes() const {
  if (scene_text_.empty())
    throw InputError("error: this run began from a checkpoint; a scene begins at its first state");
  std::vector<SceneChange> changes;
  for (const journal::Line& line : changes_) changes.push_back({line.step, journal::text_of(line.change)});
  return with_changes(scene_text_, changes);
}

void Session::save(Client client, std::string_view what) {
  const std::string stem = std::filesystem::path(scene_).stem().string();
  std::string bytes, name;
  if (what == "journal") {
    bytes = fmt::format("# voxmelt journal of {}\n{}", scene_, journal::text_of(changes_));
    name = stem + ".journal.txt";
  } else if (what == "scene") {
    bytes = scene_with_changes();
    name = stem + "-by-hand.toml";
  } else if (what == "checkpoint") {
    const Scratch scratch;
    simulation_.save(scratch.file());
    bytes = scratch.bytes();
    name = fmt::format("{}-{:06d}.checkpoint", stem, simulation_.steps_done());
  } else {
    throw InputError("error: wants `checkpoint`, `journal` or `scene`");
  }
  send_(client, file_message(name, bytes));
}

void Session::restart() {
  simulation_ = open_({});
  cut_at(simulation_.steps_done());
}

// The states that are kept have no change of their own step, nor does the one that this comes to.
void Session::go_back(std::uint32_t step) {
  const Past::Kept* kept = past_.before(step);
  const Scratch scratch;
  if (kept != nullptr) scratch.write(kept->bytes);
  Simulation again = open_(kept != nullptr ? scratch.file() : std::filesystem::path());
  if (again.steps_done() > step)
    throw InputError(fmt::format("error: this run began at step {}", again.steps_done()));
  journal::WorldOf<Simulation> world(again);
  journal::Reader replay(changes_);
  replay.seek(again.steps_done());
  while (again.steps_done() < step) {
    if (stop_.stop_requested()) return;
    replay.apply(world);
    again.step(replay.steps_until_next(again.steps_done(), step - again.steps_done()), stop_.get_token());
  }
  simulation_ = std::move(again);
  cut_at(step);
}

// Goes on from this step, and forgets what came later.
void Session::cut_at(std::uint32_t step) {
  std::erase_if(changes_, [&](const journal::Line& line) { return line.step >= step; });
  past_.cut(step);
  if (journal_) journal_->seek(step);
  if (record_) record_->restart(changes_);
  playing_ = false;
  single_ = 0;
  stale_ = true;
  tell_world({});
}

void Session::step(std::uint32_t count) {
  const Clock::time_point begin = Clock::now();
  const std::uint32_t end = simulation_.steps_done() + count;
  while (simulation_.steps_done() < end && !stop_.stop_requested()) {
    const std::uint32_t left = end - simulation_.steps_done();
    journal::WorldOf<Simulation> world(simulation_);
    if (journal_) journal_->apply(world, [&](const journal::Change& change) { write_down(change); });
    simulation_.step(journal_ ? journal_->steps_until_next(simulation_.steps_done(), left) : left,
                     stop_.get_token());
  }
  last_.step = since(begin);
  past_.offer(simulation_);
  stale_ = true;
}

// The angle of view is that of the picture's height. In a narrow window the scene's own view would be cut at
// its sides, so it steps back there.
Picture Session::picture(Quality quality) const {
  constexpr double kWidth = 4.0 / 3;
  Picture result;
  result.width = width_;
  result.height = height_;
  result.quality = quality;
  result.camera = camera_;
  const double aspect = static_cast<double>(width_) / height_;
  if (camera_ || aspect >= kWidth) return result;
  result.camera = simulation_.camera(result);
  result.camera->distance *= kWidth / aspect;
  return result;
}

// Passes over the state are worth it some times a second, and where nobody waits for the next frame.
void Session::tell_books() {
  constexpr std::chrono::milliseconds kPause{300};
  const Clock::time_point now = Clock::now();
  if (moving() && now - last_books_ < kPause) return;
  last_books_ = now;
  tell({}, books_of(simulation_, past_.bytes()));
}

void Session::show() {
  tell_books();
  painters_.note_news();
  send_textures();
  if (painters_.draw_exact()) draw();
  if (!painters_.draw_exact()) best_ = false;
  stale_ = false;
}

void Session::send_textures() {
  painters_.serve([&](Client client, std::uint64_t held) {
    const Clock::time_point begin = Clock::now();
    const Textures textures = simulation_.textures(held);
    last_.draw = since(begin);
    const Clock::time_point found = Clock::now();
    const std::string bytes = packed(textures);
    last_.encode = since(found);
    send_(client, binary(Message::Kind::textures, header("textures", Quality::normal, !moving()), bytes));
  });
}

void Session::draw() {
  const bool fast = moving();
  const Quality quality = fast ? Quality::fast : best_ && !stale_ ? Quality::best : Quality::normal;
  const Clock::time_point begin = Clock::now();
  const Picture wanted = picture(quality);
  const Frame frame =
      cells_ ? simulation_.render_cells(*cells_, wanted) : simulation_.render(wanted, stop_.get_token());
  last_.draw = since(begin);
  const Clock::time_point drawn = Clock::now();
  const std::string image = fast ? jpeg_of(frame) : png_of(frame);
  last_.encode = since(drawn);
  const MessagePtr message = binary(Message::Kind::frame, header("frame", quality, !fast), image);
  for (const Client client : painters_.exact_pages()) send_(client, message);
  if (quality == Quality::best || fast) best_ = false;
  drawn_ = quality;
}

std::string Session::header(const char* type, Quality quality, bool exact) const {
  const Camera camera = simulation_.camera(picture(quality));
  const State state = simulation_.state();
  json head{{"type", type},
            {"step", simulation_.steps_done()},
            {"first", first_},
            {"playing", playing_},
            {"speed", speed_},
            {"quality", name_of(quality)},
            {"exact", exact},
            {"size", {width_, height_}},
            {"camera",
             {{"azimuth", camera.azimuth},
              {"elevation", camera.elevation},
              {"distance", camera.distance},
              {"target", array_of(camera.target)},
              {"field_of_view", camera.field_of_view},
              {"parallel", camera.projection == Projection::orthographic}}},
            {"solid", state.solid.count()},
            {"liquid", state.liquid.count()},
            {"ms", {{"step", last_.step}, {"draw", last_.draw}, {"encode", last_.encode}}}};
  if (cells_) head["cells"] = json_of(*cells_);
  // A pass over the state is worth it where nobody waits for the next frame.
  if (exact) head["digest"] = fmt::format("{:016x}", simulation_.digest());
  return head.dump();
}

void Session::tell_world(std::optional<Client> client) { tell(client, world_of(simulation_, scene_)); }

void Session::tell(std::optional<Client> client, std::string text) {
  send_(client, std::make_shared<const Message>(Message{std::move(text), Message::Kind::text}));
}

void Session::pick(Client client, int x, int y) {
  const Picture seen = picture(Quality::fast);
  const std::optional<Hit> hit =
      cells_ ? simulation_.pick_cell(x, y, *cells_, seen) : simulation_.pick(x, y, seen);
  json answer{{"type", "pick"}, {"at", {x, y}}, {"step", simulation_.steps_done()}};
  if (hit) {
    // The sides of the ground end where the grid does, and views do not check coordinates.
    const Grid grid = simulation_.grid();
    const Cell cell{std::clamp(hit->matter.x, 0, grid.x - 1), std::clamp(hit->matter.y, 0, grid.y - 1),
                    std::clamp(hit->matter.z, 0, grid.z - 1)};
    json fields = json::object();
    for (const NamedField& field : simulation_.state().fields)
      fields[std::string(field.name)] = field.at(cell.x, cell.y, cell.z);
    answer["shown"] = name_of(hit->shown);
    answer["position"] = array_of(hit->position);
    answer["cell"] = {cell.x, cell.y, cell.z};
    answer["fields"] = fields;
  }
  tell(client, answer.dump());
}

}  // namespace voxmelt::view
