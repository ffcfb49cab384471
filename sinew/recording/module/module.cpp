// Module that contains libmatio.
#include <matio.h>

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/config/utf8.h"
#include "sinew/recording/module/matlab.h"

namespace {

std::string last_words;  // the library's last error message

// Stores messages: by default the library prints them and ends the program after a fatal error.
void listen(int /*level*/, char* words) { last_words = words; }

const char* words() { return last_words.c_str(); }

template <class T>
std::vector<double> as_doubles(const matvar_t& of, std::size_t count) {
  const T* const values = static_cast<const T*>(of.data);
  return {values, values + count};
}

// Converts a matrix of real numbers; returns nothing for other variables.
std::vector<double> numbers(const matvar_t& of, std::size_t count) {
  switch (of.class_type) {
    case MAT_C_DOUBLE:
      return as_doubles<double>(of, count);
    case MAT_C_SINGLE:
      return as_doubles<float>(of, count);
    case MAT_C_INT8:
      return as_doubles<std::int8_t>(of, count);
    case MAT_C_UINT8:
      return as_doubles<std::uint8_t>(of, count);
    case MAT_C_INT16:
      return as_doubles<std::int16_t>(of, count);
    case MAT_C_UINT16:
      return as_doubles<std::uint16_t>(of, count);
    case MAT_C_INT32:
      return as_doubles<std::int32_t>(of, count);
    case MAT_C_UINT32:
      return as_doubles<std::uint32_t>(of, count);
    case MAT_C_INT64:
      return as_doubles<std::int64_t>(of, count);
    case MAT_C_UINT64:
      return as_doubles<std::uint64_t>(of, count);
    default:
      return {};
  }
}

const char* kind_of(const matvar_t& of) {
  if (of.isComplex != 0) return "complex numbers";
  switch (of.class_type) {
    case MAT_C_CELL:
      return "a cell array";
    case MAT_C_SPARSE:
      return "a sparse matrix";
    case MAT_C_FUNCTION:
      return "a function";
    case MAT_C_OBJECT:
    case MAT_C_OPAQUE:
      return "an object of a class; of a table, table2struct(T, 'ToScalar', true) makes vectors";
    default:
      return "more than two dimensions";
  }
}

// Converts the letters of a text, which are bytes or UTF-16, to UTF-8.
std::string text_of(const matvar_t& of, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned letter = of.data_size == 2 ? static_cast<const std::uint16_t*>(of.data)[i]
                                              : static_cast<const std::uint8_t*>(of.data)[i];
    if (of.data_size == 2)
      sinew::config::append_letter(letter, out);
    else
      out += static_cast<char>(letter);
  }
  return out;
}

class Walk {
 public:
  explicit Walk(const SinewMatlabSink& sink) : sink_(sink) {}

  // Passes on a variable; returns false if the file ends within it.
  bool variable(matvar_t* of, const std::string& name) {
    if (!of) return true;
    if (of->class_type == MAT_C_STRUCT) return structure(*of, name);
    std::size_t count = 1;
    for (int i = 0; i < of->rank; ++i) count *= of->dims[i];
    if (of->class_type == MAT_C_EMPTY || count == 0) return true;
    if (of->class_type == MAT_C_CHAR) {
      if (!of->data) return false;
      sink_.text(sink_.object, name.c_str(), text_of(*of, count).c_str());
      return true;
    }
    const bool numeric = of->class_type >= MAT_C_DOUBLE && of->class_type <= MAT_C_UINT64;
    if (!numeric || of->isComplex != 0 || of->rank < 1) return other(*of, name);
    if (!of->data) return false;
    const std::vector<double> values = numbers(*of, count);
    // Simulink stores samples of a vector as 1 x n x times; other arrays of more than two
    // dimensions are reported.
    if (of->rank > 2 && of->dims[0] * of->dims[1] * of->dims[2] != count) return other(*of, name);
    return matrix(*of, name, values);
  }

 private:
  bool matrix(const matvar_t& of, const std::string& name, const std::vector<double>& values) {
    if (of.rank == 3) {
      // Transposed: time runs down the rows.
      const std::size_t width = of.dims[0] * of.dims[1], rows = of.dims[2];
      std::vector<double> turned(values.size());
      for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < width; ++k) turned[k * rows + i] = values[i * width + k];
      sink_.matrix(sink_.object, name.c_str(), rows, width, turned.data());
      return true;
    }
    const std::size_t rows = of.dims[0];
    sink_.matrix(sink_.object, name.c_str(), rows, values.size() / rows, values.data());
    return true;
  }

  bool structure(matvar_t& of, const std::string& name) {
    std::size_t count = 1;
    for (int i = 0; i < of.rank; ++i) count *= of.dims[i];
    const unsigned fields = Mat_VarGetNumberOfFields(&of);
    char* const* names = Mat_VarGetStructFieldnames(&of);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string element = count > 1 ? name + "(" + std::to_string(i + 1) + ")" : name;
      for (unsigned f = 0; f < fields; ++f)
        if (!variable(Mat_VarGetStructFieldByIndex(&of, f, i), element + "." + names[f]))
          return false;
    }
    return true;
  }

  bool other(const matvar_t& of, const std::string& name) {
    sink_.other(sink_.object, name.c_str(), kind_of(of));
    return true;
  }

  const SinewMatlabSink& sink_;
};

bool read(const char* path, const SinewMatlabSink* sink) {
  last_words.clear();
  Mat_LogInitFunc("sinew", listen);
  mat_t* const file = Mat_Open(path, MAT_ACC_RDONLY);
  if (!file) return false;
  bool whole = true;
  while (matvar_t* const of = Mat_VarReadNext(file)) {
    whole = whole && Walk(*sink).variable(of, of->name ? of->name : "");
    Mat_VarFree(of);
    if (!whole) break;
  }
  Mat_Close(file);
  return whole;
}

}  // namespace

const SinewMatlab* sinew_matlab_1() {
  static const SinewMatlab functions{read, words};
  return &functions;
}
