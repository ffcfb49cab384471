// recording/module/matlab.h - interface of the module that contains libmatio: the variables of a
// MAT file. The program opens the module only for such files.
#pragma once

#include <cstddef>

extern "C" {

// Receives the contents of a file, variable by variable. The field of a struct is named
// `log.angle`, a field in an array of structs `log.signals(2).values`.
struct SinewMatlabSink {
  void* object;
  // Receives a matrix of real numbers in column-major order. The values are valid only during the
  // call.
  void (*matrix)(void* object, const char* name, std::size_t rows, std::size_t columns,
                 const double* values);
  void (*text)(void* object, const char* name, const char* text);
  // Receives the type of a variable of another kind: "a cell array", "complex numbers".
  void (*other)(void* object, const char* name, const char* what);
};

// Functions of the module.
struct SinewMatlab {
  // Returns false if the file cannot be opened or ends within a variable; words() then returns the
  // reason.
  bool (*read)(const char* path, const SinewMatlabSink* sink);
  const char* (*words)();
};

const SinewMatlab* sinew_matlab_1();  // the number is the version of the structs

}  // extern "C"
