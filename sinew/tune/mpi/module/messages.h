// tune/mpi/module/messages.h - what the module with the MPI library in it offers: bytes from
// process to process. The program opens it when it was started by mpirun, and only then.
#pragma once

#include <cstddef>

extern "C" {

// Functions return false, or no size, where MPI failed.
struct SinewMessages {
  bool (*begin)(int* rank, int* size);  // joins the others; once in a process
  bool (*send)(int to, const char* bytes, std::size_t count);

  // Waits that long for a message of anybody, without burning a processor. Returns false where none
  // came.
  bool (*wait)(double seconds, int* from, std::size_t* count);
  bool (*receive)(int from, char* bytes, std::size_t count);  // the one that wait() saw

  void (*end)();  // waits for the others to do so too
};

const SinewMessages* sinew_messages_1();  // the number is the version of the struct

}  // extern "C"
