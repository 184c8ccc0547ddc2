// A struct of the public headers becomes a class of Python whose objects do not change: an attribute that is
// a copy would otherwise take an assignment without any effect. Names, defaults and comments are those of
// C++.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "python/docs.h"

namespace voxmelt::python {

namespace py = pybind11;

// Everything of a class that does not depend on its struct, so that it is compiled once.
class RecordFields {
 public:
  using Getter = std::function<py::object(py::handle self)>;
  using Setter = std::function<void(void* made, py::handle value)>;

  explicit RecordFields(std::string scope) : scope_(std::move(scope)) {}

  void add(const py::object& cls, const char* name, Getter getter, Setter setter);
  // Gives the class what all values have (voxmelt/_record.py). `defaults` is None where users make none.
  void finish(const py::object& cls, const py::object& defaults) const;
  // Fills a struct from the arguments of its constructor.
  void fill(void* made, const py::args& values, const py::kwargs& named) const;

 private:
  struct Field {
    std::string name;
    Setter set;
  };
  const Field& field(const std::string& name) const;
  void set(const Field& field, void* made, py::handle value) const;

  std::string scope_;
  std::vector<Field> fields_;
};

// Returns lists as tuples: a list would take changes that nobody sees.
py::object frozen(py::object value);

template <class T>
class Record {
 public:
  Record(py::module_& m, const char* name)
      : class_(m, name, doc(name)), fields_(std::make_shared<RecordFields>(name)) {}

  // A name may differ from that in C++, where Python has a keyword.
  template <class Member>
  Record& field(const char* name, Member T::*member) {
    fields_->add(
        class_, name, [member](py::handle self) { return frozen(py::cast(self.cast<const T&>().*member)); },
        [member](void* made, py::handle value) { static_cast<T*>(made)->*member = value.cast<Member>(); });
    return *this;
  }

  // A field of a record that only the library makes. It may be an object of Python.
  template <class Member>
  Record& shows(const char* name, Member T::*member) {
    const auto get = [member](py::handle self) -> py::object {
      const Member& value = self.cast<const T&>().*member;
      if constexpr (std::is_base_of_v<py::object, Member>)
        return value;
      else
        return frozen(py::cast(value));
    };
    fields_->add(class_, name, get, {});
    return *this;
  }

  // Ends a record that programs make themselves.
  py::class_<T>& made_by_users() {
    const std::shared_ptr<const RecordFields> fields = fields_;
    class_.def(py::init([fields](const py::args& values, const py::kwargs& named) {
      T made{};
      fields->fill(&made, values, named);
      return made;
    }));
    fields_->finish(class_, py::cast(T{}));
    return class_;
  }
  // Ends a record that only the library makes.
  py::class_<T>& made_here() {
    fields_->finish(class_, py::none());
    return class_;
  }

 private:
  py::class_<T> class_;
  std::shared_ptr<RecordFields> fields_;
};

}  // namespace voxmelt::python

// The books have 128 bits, and the integers of Python have no end.
namespace pybind11::detail {
template <>
struct type_caster<__int128> {
  PYBIND11_TYPE_CASTER(__int128, const_name("int"));
  static handle cast(__int128 value, return_value_policy, handle);
};
}  // namespace pybind11::detail
