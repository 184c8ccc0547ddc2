// The class Simulation: no call holds the GIL while it computes.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <voxmelt/voxmelt.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "python/docs.h"
#include "python/handle.h"
#include "python/module.h"
#include "python/record.h"
#include "python/state.h"
#include "python/textures.h"

namespace voxmelt::python {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPatience{50};  // between two looks at signals

// An object with is_set(), such as a threading.Event, or None.
bool is_set(const py::object& stop) { return !stop.is_none() && stop.attr("is_set")().cast<bool>(); }

void check_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// Runs `work` without the GIL.
template <class Work>
auto released(Work&& work) {
  const py::gil_scoped_release release;
  return work();
}

std::uint32_t step(Handle& handle, std::int64_t count, const py::object& stop, const py::object& progress) {
  constexpr std::int64_t most = std::numeric_limits<std::uint32_t>::max();
  if (count < 0 || count > most)
    throw InputError("step: error: count = " + std::to_string(count) + " is not in 0.." +
                     std::to_string(most));
  const Use use(handle, Access::step);
  check_signals();
  if (is_set(stop)) return 0;
  std::stop_source source;
  Clock::time_point looked = Clock::now();
  const bool each_step = !stop.is_none() || !progress.is_none();
  return released([&] {
    return use->step(static_cast<std::uint32_t>(count), source.get_token(),
                     [&](std::uint32_t done, std::uint32_t of) {
                       if (!each_step && Clock::now() - looked < kPatience) return;
                       const py::gil_scoped_acquire acquire;
                       looked = Clock::now();
                       check_signals();
                       if (!progress.is_none()) progress(done, of);
                       if (is_set(stop)) source.request_stop();
                     });
  });
}

// Draws in another thread, while this one looks at signals.
template <class Work>
Frame drawn(const py::object& stop, Work&& work) {
  std::stop_source source;
  if (is_set(stop)) source.request_stop();
  std::optional<py::error_already_set> interrupt;
  std::future<Frame> frame = std::async(std::launch::async, [&] { return work(source.get_token()); });
  while (released([&] { return frame.wait_for(kPatience); }) != std::future_status::ready) try {
      check_signals();
      if (is_set(stop)) source.request_stop();
    } catch (py::error_already_set& error) {
      interrupt.emplace(error);
      source.request_stop();
      break;
    }
  released([&] { frame.wait(); });
  if (interrupt) throw std::move(*interrupt);
  return frame.get();
}

// A frame whose bytes belong to arrays of NumPy.
struct FrameOfArrays {
  int width, height;
  std::size_t stride;
  py::object rgb, depth;
  Position eye;
};

template <class Number>
py::array array_of(std::vector<Number> numbers, const std::vector<py::ssize_t>& shape,
                   const std::vector<py::ssize_t>& strides) {
  auto* const kept = new std::vector<Number>(std::move(numbers));
  const py::capsule owner(kept, [](void* held) { delete static_cast<std::vector<Number>*>(held); });
  return py::array(py::dtype::of<Number>(), shape, strides, kept->data(), owner);
}

FrameOfArrays to_arrays(Frame frame) {
  const py::ssize_t width = frame.width, height = frame.height;
  constexpr py::ssize_t real = sizeof(float);
  py::object depth = py::none();
  if (!frame.depth.empty()) depth = array_of(std::move(frame.depth), {height, width}, {width * real, real});
  const auto stride = static_cast<py::ssize_t>(frame.stride);
  return {frame.width,      frame.height,
          frame.stride,     array_of(std::move(frame.rgb), {height, width, 3}, {stride, 3, 1}),
          std::move(depth), frame.eye};
}

FrameOfArrays render(Handle& handle, const Picture& picture, const py::object& stop) {
  const Use use(handle, Access::draw);
  return to_arrays(drawn(stop, [&](const std::stop_token& token) { return use->render(picture, token); }));
}

FrameOfArrays render_cells(Handle& handle, const CellView& view, const Picture& picture) {
  const Use use(handle, Access::draw);
  return to_arrays(
      drawn(py::none(), [&](const std::stop_token&) { return use->render_cells(view, picture); }));
}

// Makes a method of a member function that needs no more than arguments: (access, member).
template <class Result, class... Arguments>
auto method(Access access, Result (Simulation::*member)(Arguments...)) {
  return [access, member](Handle& handle, Arguments... arguments) -> std::decay_t<Result> {
    const Use use(handle, access);
    return released([&] { return (handle.simulation.*member)(std::forward<Arguments>(arguments)...); });
  };
}
template <class Result, class... Arguments>
auto method(Access access, Result (Simulation::*member)(Arguments...) const) {
  return [access, member](Handle& handle, Arguments... arguments) -> std::decay_t<Result> {
    const Use use(handle, access);
    return released([&] { return (handle.simulation.*member)(std::forward<Arguments>(arguments)...); });
  };
}

void add_frame(py::module_& m) {
  py::class_<FrameOfArrays> frame(m, "Frame", doc("Frame"));
  frame.attr("__module__") = "voxmelt";
  frame.def_readonly("width", &FrameOfArrays::width, doc("Frame::width"))
      .def_readonly("height", &FrameOfArrays::height, doc("Frame::height"))
      .def_readonly("stride", &FrameOfArrays::stride, doc("Frame::stride"))
      .def_readonly("rgb", &FrameOfArrays::rgb, doc("Frame::rgb"))
      .def_readonly("depth", &FrameOfArrays::depth, doc("Frame::depth"))
      .def_property_readonly(
          "eye", [](const FrameOfArrays& f) { return frozen(py::cast(f.eye)); }, doc("Frame::eye"));
}

// Names and comments are those of the headers.
class Methods {
 public:
  explicit Methods(py::class_<Handle>& cls) : cls_(cls) {}

  template <class Member, class... Arguments>
  Methods& add(const char* name, Access access, Member member, const Arguments&... arguments) {
    cls_.def(name, method(access, member), doc(std::string("Simulation::") + name), arguments...);
    return *this;
  }

 private:
  py::class_<Handle>& cls_;
};

void add_looks(Methods methods) {
  using S = Simulation;
  methods.add("title", Access::look, &S::title)
      .add("warnings", Access::look, &S::warnings)
      .add("scene_steps", Access::look, &S::scene_steps)
      .add("implementation", Access::look, &S::implementation)
      .add("threads", Access::look, &S::threads)
      .add("steps_done", Access::look, &S::steps_done)
      .add("step_number", Access::look, &S::step_number)
      .add("scene_text", Access::look, &S::scene_text)
      .add("grid", Access::look, &S::grid)
      .add("digest", Access::look, &S::digest)
      .add("ledgers", Access::look, &S::ledgers)
      .add("loose_cells", Access::look, &S::loose_cells)
      .add("changes", Access::look, &S::changes, py::arg("version") = 0)
      .add("numbers", Access::look, &S::numbers)
      .add("heat_sources", Access::look, &S::heat_sources)
      .add("vents", Access::look, &S::vents)
      .add("drains", Access::look, &S::drains)
      .add("export_state", Access::look, &S::export_state, py::arg("folder"), py::arg("format") = "npy")
      .add("save", Access::look, &S::save, py::arg("file"));
}

void add_changes(Methods methods) {
  using S = Simulation;
  methods.add("restart", Access::change, &S::restart)
      .add("set", Access::change, &S::set, py::arg("key"), py::arg("value"))
      .add("set_heat_sources", Access::change, &S::set_heat_sources, py::arg("sources"))
      .add("set_vents", Access::change, &S::set_vents, py::arg("vents"))
      .add("set_drains", Access::change, &S::set_drains, py::arg("drains"))
      .add("pour", Access::change, &S::pour, py::arg("at"), py::arg("radius"), py::arg("temperature"))
      .add("carve", Access::change, &S::carve, py::arg("at"), py::arg("radius"));
}

void add_pictures(py::class_<Handle>& cls) {
  using S = Simulation;
  const py::arg_v picture("picture", Picture{}, "Picture()"), view("view", CellView{}, "CellView()");
  Methods(cls)
      .add("camera", Access::look, &S::camera, picture)
      .add("pick", Access::draw, &S::pick, py::arg("x"), py::arg("y"), picture)
      .add("pick_cell", Access::draw, &S::pick_cell, py::arg("x"), py::arg("y"), view, picture)
      .add("draw", Access::draw, &S::draw, py::arg("file"), picture);
  cls.def("render", &render, doc("Simulation::render"), picture, py::arg("stop") = py::none());
  cls.def("render_cells", &render_cells, doc("Simulation::render_cells"), view, picture);
  cls.def("textures", &textures_of, doc("Simulation::textures"), py::arg("version") = 0);
}

}  // namespace

void add_simulation(py::module_& m) {
  add_frame(m);
  py::class_<Handle> cls(m, "_Simulation", doc("Simulation"));
  cls.def(py::init([](const std::filesystem::path& scene, std::vector<std::string> overrides,
                      const std::string& implementation, int threads) {
            return released([&] {
              return std::make_unique<Handle>(scene, Options{std::move(overrides), implementation, threads});
            });
          }),
          doc("Simulation::Simulation"), py::arg("scene"), py::kw_only(),
          py::arg("overrides") = std::vector<std::string>(), py::arg("implementation") = "auto",
          py::arg("threads") = 0);
  cls.def("step", &step, doc("Simulation::step"), py::arg("count") = 1, py::arg("stop") = py::none(),
          py::arg("progress") = py::none());
  cls.def(
      "state",
      [](const py::object& self) {
        return StateOfHandle{self, self.cast<Handle&>().changed};
      },
      doc("Simulation::state"));
  add_looks(Methods(cls));
  add_changes(Methods(cls));
  add_pictures(cls);
}

}  // namespace voxmelt::python
