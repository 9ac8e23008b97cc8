// Trouble as Python exceptions: one type per kind, the text that the program prints.
#include <map>

#include "base/trouble.h"
#include "bindings.h"

namespace brisance::python {
namespace {

struct Kind {
  ExitCode code;
  const char* name;
  const char* doc;
  PyObject* alsoA;  ///< exception of Python's own that it is one of, or none
};

/// The types live as long as the interpreter.
std::map<ExitCode, PyObject*>& types() {
  static std::map<ExitCode, PyObject*> all;
  return all;
}

PyObject* makeType(const Kind& kind, PyObject* base) {
  py::tuple bases =
      kind.alsoA ? py::make_tuple(py::handle(base), py::handle(kind.alsoA)) : py::make_tuple(py::handle(base));
  const std::string name = fmt::format("brisance.{}", kind.name);
  PyObject* type = PyErr_NewExceptionWithDoc(name.c_str(), kind.doc, bases.ptr(), nullptr);
  if (!type) throw py::error_already_set();
  py::setattr(type, "exit_code", py::int_(static_cast<int>(kind.code)));
  return type;
}

void raise(const Trouble& trouble) {
  const auto type = types().find(trouble.code);
  PyErr_SetString(type == types().end() ? types()[ExitCode::failed] : type->second, trouble.line.c_str());
}

/// What is not named here is Python's or pybind11's own, or a bug.
void translate(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): as pybind11 calls it
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error&) {
    raise(troubleAtHand());
  } catch (const std::bad_alloc&) {
    raise(troubleAtHand());
  } catch (const std::system_error&) {
    raise(troubleAtHand());
  }
}

}  // namespace

void bindExceptions(py::module_& module) {
  const Kind error{ExitCode::failed, "Error",
                   "Failed while working; what the others are kinds of. exit_code: that of the program.", nullptr};
  const Kind kinds[] = {
      {ExitCode::badScene, "SceneError", "A scene, or what a function was given, is wrong.", PyExc_ValueError},
      {ExitCode::badInput, "DamagedFileError", "A file is damaged or not accepted.", nullptr},
      {ExitCode::noRoom, "NoRoomError", "Disk full, directory not writable, not enough memory.", nullptr},
      {ExitCode::unstable, "UnstableError", "The simulation left its stable range.", PyExc_ArithmeticError}};
  PyObject* base = makeType(error, PyExc_Exception);
  types()[error.code] = base;
  for (const Kind& kind : kinds) types()[kind.code] = makeType(kind, base);
  module.attr(error.name) = py::handle(base);
  for (const Kind& kind : kinds) module.attr(kind.name) = py::handle(types()[kind.code]);
  py::register_exception_translator(translate);
}

}  // namespace brisance::python
