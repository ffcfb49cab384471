// tune/mpi/module/messages.h - interface of the module with the MPI library: messages of bytes
// between processes. The program opens the module only if mpirun started it.
#pragma once

#include <cstddef>

extern "C" {

// Functions return false if MPI failed.
struct SinewMessages {
  bool (*begin)(int* rank, int* size);  // joins the others; once per process
  bool (*send)(int to, const char* bytes, std::size_t count);

  // Waits at most that long for a message from any process, without busy waiting. Returns false if
  // none arrived.
  bool (*wait)(double seconds, int* from, std::size_t* count);
  bool (*receive)(int from, char* bytes, std::size_t count);  // the message found by wait()

  void (*end)();  // waits until the others call it too
};

const SinewMessages* sinew_messages_1();  // the number is the version of the struct

}  // extern "C"
