// Fields of a state as NumPy arrays (z, y, x). An array is a copy, or a view that holds its simulation still.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <voxmelt/voxmelt.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>

#include "python/docs.h"
#include "python/handle.h"
#include "python/module.h"
#include "python/state.h"

namespace voxmelt::python {
namespace {

using Cells = std::variant<MaskView, ByteView, FieldView>;

std::array<py::ssize_t, 3> shape_of(Grid g) { return {g.z, g.y, g.x}; }

// Is the memory of a view: as long as an array points to it, the simulation does not change.
py::capsule pin(py::object owner) {
  ++owner.cast<Handle&>().views;
  const void* const held_one = owner.release().ptr();
  return py::capsule(held_one, [](void* held) {
    const auto handle = py::reinterpret_steal<py::object>(static_cast<PyObject*>(held));
    --handle.cast<Handle&>().views;
  });
}

py::array copy_of(const MaskView& mask) {
  const Grid g = mask.grid();
  py::array_t<bool> made(shape_of(g));
  bool* cell = made.mutable_data();
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y, cell += g.x) {
      std::fill_n(cell, g.x, false);
      const auto words = mask.row(y, z);
      for (std::size_t w = 0; w < words.size(); ++w)
        for (std::uint64_t left = words[w]; left != 0; left &= left - 1)
          cell[64 * w + std::countr_zero(left)] = true;
    }
  return made;
}

template <class Number>
py::array copy_of(const NumberView<Number>& field) {
  const Grid g = field.grid();
  py::array_t<Number> made(shape_of(g));
  Number* cell = made.mutable_data();
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y, cell += g.x) std::ranges::copy(field.row(y, z), cell);
  return made;
}

py::array view_of(const MaskView&, const py::object&) {
  throw py::type_error("a mask has a bit for each cell, and NumPy has no arrays of bits: take the copy");
}

template <class Number>
py::array view_of(const NumberView<Number>& field, const py::object& owner) {
  constexpr auto size = static_cast<py::ssize_t>(sizeof(Number));
  const std::array<py::ssize_t, 3> strides{static_cast<py::ssize_t>(field.slice_stride()) * size,
                                           static_cast<py::ssize_t>(field.row_stride()) * size, size};
  py::array made(py::dtype::of<Number>(), shape_of(field.grid()), strides, field.data(), pin(owner));
  py::detail::array_proxy(made.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return made;
}

NamedField named(const State& state, const std::string& name) {
  if (name == "energy") return {"energy", "", state.energy};  // these stand in every state
  if (name == "heat") return {"heat", "", state.heat};
  for (const NamedField& field : state.fields)
    if (field.name == name) return field;
  throw py::key_error("this state has no field " + name);
}

// A field by its name. It keeps no address.
struct FieldOfState {
  StateOfHandle state;
  std::string name, unit;
};

py::array cells_of(const StateOfHandle& state, const std::string& name) {
  const Use use = state.look();
  return std::visit([](const auto& cells) { return copy_of(cells); }, named(use->state(), name).cells);
}

py::array pinned_cells_of(const StateOfHandle& state, const std::string& name) {
  const Use use = state.look();
  return std::visit([&](const auto& cells) { return view_of(cells, state.owner); },
                    named(use->state(), name).cells);
}

py::tuple fields_of(const StateOfHandle& state) {
  const Use use = state.look();
  py::list fields;
  for (const NamedField& field : use->state().fields)
    fields.append(FieldOfState{state, std::string(field.name), std::string(field.unit)});
  return py::tuple(fields);
}

constexpr const char* kViewDoc =
    "Returns the numbers in place, as an array (z, y, x) that cannot be written.\n"
    "While it or any array made of it lives, the simulation does not change: step() and all else that\n"
    "would change it raise BufferError.";

}  // namespace

Use StateOfHandle::look() const {
  auto& handle = owner.cast<Handle&>();
  if (handle.changed != changed)
    throw std::runtime_error(
        "the simulation has moved on from this state; keep copies of its fields, or call state() anew");
  return {handle, Access::look};
}

void add_state(py::module_& m) {
  py::class_<FieldOfState>(m, "NamedField", doc("NamedField"))
      .def_readonly("name", &FieldOfState::name, doc("NamedField::name"))
      .def_readonly("unit", &FieldOfState::unit, doc("NamedField::unit"))
      .def_property_readonly(
          "cells", [](const FieldOfState& f) { return cells_of(f.state, f.name); },
          "A copy of its numbers, an array (z, y, x).")
      .def(
          "view", [](const FieldOfState& f) { return pinned_cells_of(f.state, f.name); }, kViewDoc);
  py::class_<StateOfHandle> state(m, "State", doc("State"));
  for (const char* name : {"solid", "liquid", "inert", "amount", "energy", "heat"})
    state.def_property_readonly(
        name, [name](const StateOfHandle& s) { return cells_of(s, name); },
        doc("State::" + std::string(name)));
  state.def_property_readonly(
      "grid", [](const StateOfHandle& s) { return s.look()->grid(); }, doc("State::grid"));
  state.def_property_readonly("fields", &fields_of, doc("State::fields"));
  state.def("view", &pinned_cells_of, kViewDoc, py::arg("name"));
  for (const char* name : {"NamedField", "State"}) m.attr(name).attr("__module__") = "voxmelt";
}

}  // namespace voxmelt::python
