// python/binding/module.cpp - Python module `sinew._sinew`, which is part of the package `sinew`.
#include "python/binding/bind.h"

PYBIND11_MODULE(_sinew, m) {
  m.doc() = "The library of Sinew. Use `import sinew`.";
  m.attr("version") = SINEW_VERSION;
  sinew::python::bind_errors(m);
  sinew::python::bind_experiment(m);
  sinew::python::bind_files(m);
  sinew::python::bind_values(m);
  sinew::python::bind_recording(m);
  sinew::python::bind_compare(m);
  sinew::python::bind_simulation(m);
  sinew::python::bind_loop(m);
  sinew::python::bind_episode(m);
  sinew::python::bind_run(m);
  sinew::python::bind_imported(m);
  sinew::python::bind_sweep(m);
  sinew::python::bind_ensemble(m);
  sinew::python::bind_laws(m);
  sinew::python::bind_muscle(m);
  sinew::python::bind_identify(m);
  sinew::python::bind_fmu(m);
  sinew::python::bind_figures(m);
  sinew::python::bind_identify_tables(m);
  sinew::python::bind_design(m);
}
