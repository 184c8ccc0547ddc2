// The Python module voxmelt._voxmelt: the public library, by the same names. Errors are exceptions here.
#include "python/module.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <voxmelt/voxmelt.h>

#include <exception>
#include <string>
#include <utility>

#include "python/docs.h"
#include "python/textures.h"

namespace py = pybind11;

namespace voxmelt::python {
namespace {

// They are kept forever, as the module is.
struct Exceptions {
  PyObject *error, *input, *output, *resource, *stopped;
};

PyObject* exception(py::module_& m, const char* name, const py::tuple& bases) {
  PyObject* const made =
      PyErr_NewExceptionWithDoc(("voxmelt." + std::string(name)).c_str(), doc(name), bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  m.attr(name) = py::handle(made);
  return made;
}

void add_errors(py::module_& m) {
  static Exceptions all{};
  all.error = exception(m, "Error", py::make_tuple(py::handle(PyExc_RuntimeError)));
  const py::handle error = all.error;
  all.input = exception(m, "InputError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  all.output = exception(m, "OutputError", py::make_tuple(error, py::handle(PyExc_OSError)));
  all.resource = exception(m, "ResourceError", py::make_tuple(error));
  all.stopped = exception(m, "Stopped", py::make_tuple(error));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const InputError& e) {
      PyErr_SetString(all.input, e.what());
    } catch (const OutputError& e) {
      PyErr_SetString(all.output, e.what());
    } catch (const ResourceError& e) {
      PyErr_SetString(all.resource, e.what());
    } catch (const Stopped& e) {
      PyErr_SetString(all.stopped, e.what());
    } catch (const Error& e) {
      PyErr_SetString(all.error, e.what());
    }
  });
}

}  // namespace
}  // namespace voxmelt::python

PYBIND11_MODULE(_voxmelt, m) {
  using voxmelt::python::doc;
  m.doc() = "The library of voxmelt (docs/python.md).";
  voxmelt::python::add_errors(m);
  voxmelt::python::add_records(m);
  voxmelt::python::add_textures(m);
  voxmelt::python::add_state(m);
  voxmelt::python::add_simulation(m);
  m.def("version", &voxmelt::version, doc("version"));
  m.def("implementations", &voxmelt::implementations, doc("implementations"));
  m.def("devices", &voxmelt::devices, doc("devices"));
  m.def("formats", &voxmelt::formats, doc("formats"));
  m.def("changeable_keys", &voxmelt::changeable_keys, doc("changeable_keys"));
  m.def("with_changes", &voxmelt::with_changes, doc("with_changes"), py::arg("scene_text"), py::arg("more"));
  m.def("legend", &voxmelt::legend, doc("legend"), py::arg("colours"));
}
