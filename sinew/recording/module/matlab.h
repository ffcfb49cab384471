// recording/module/matlab.h - what the module with libmatio in it offers: the variables of a MAT
// file. The program opens it for such a file alone.
#pragma once

#include <cstddef>

extern "C" {

// Takes what a file holds, variable by variable. A field of a struct is called `log.angle`, one of
// an array of structs `log.signals(2).values`.
struct SinewMatlabSink {
  void* object;
  // A matrix of real numbers, column by column. The values are gone when the call returns.
  void (*matrix)(void* object, const char* name, std::size_t rows, std::size_t columns,
                 const double* values);
  void (*text)(void* object, const char* name, const char* text);
  // Names what is neither: "a cell array", "complex numbers".
  void (*other)(void* object, const char* name, const char* what);
};

// Holds the functions of the module.
struct SinewMatlab {
  // False: the file cannot be opened, or ends within a variable; `words` says why.
  bool (*read)(const char* path, const SinewMatlabSink* sink);
  const char* (*words)();
};

const SinewMatlab* sinew_matlab_1();  // the number is the version of the structs

}  // extern "C"
