#include "python/record.h"

#include <voxmelt/ledgers.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace voxmelt::python {
py::object frozen(py::object value) {
  if (!py::isinstance<py::list>(value)) return value;
  return py::tuple(value);
}

void RecordFields::add(const py::object& cls, const char* name, Getter getter, Setter setter) {
  std::string in_cpp = name;
  if (in_cpp.back() == '_') in_cpp.pop_back();
  const py::object property =
      py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyProperty_Type));
  cls.attr(name) =
      property(py::cpp_function(std::move(getter)), py::none(), py::none(), doc(scope_ + "::" + in_cpp));
  fields_.push_back({name, std::move(setter)});
}

void RecordFields::finish(const py::object& cls, const py::object& defaults) const {
  py::list names;
  for (const Field& field : fields_) names.append(field.name);
  py::module_::import("voxmelt._record").attr("finish")(cls, py::tuple(names), defaults);
}

void RecordFields::set(const Field& field, void* made, py::handle value) const {
  try {
    field.set(made, value);
  } catch (const py::cast_error&) {
    throw py::type_error(scope_ + ": " + field.name + " = " + std::string(py::repr(value)) +
                         " has the wrong type");
  }
}

const RecordFields::Field& RecordFields::field(const std::string& name) const {
  const auto found = std::ranges::find(fields_, name, &Field::name);
  if (found == fields_.end()) throw py::type_error(scope_ + " has no field '" + name + "'");
  return *found;
}

void RecordFields::fill(void* made, const py::args& values, const py::kwargs& named) const {
  if (values.size() > fields_.size())
    throw py::type_error(scope_ + " has " + std::to_string(fields_.size()) + " fields, not " +
                         std::to_string(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) set(fields_[i], made, values[i]);
  for (const auto& [key, value] : named) {
    const Field& chosen = field(py::str(key));
    if (static_cast<std::size_t>(&chosen - fields_.data()) < values.size())
      throw py::type_error(scope_ + ": " + chosen.name + " is given twice");
    set(chosen, made, value);
  }
}

}  // namespace voxmelt::python

namespace pybind11::detail {

handle type_caster<__int128>::cast(__int128 value, return_value_policy, handle) {
  return PyLong_FromString(voxmelt::to_string(value).c_str(), nullptr, 10);
}

}  // namespace pybind11::detail
