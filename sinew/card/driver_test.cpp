// Programs and memory of a card, with the substitute for the driver in tests/graphics_card.
#include "sinew/card/driver.h"

#include <dlfcn.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "tests/places.h"

namespace sinew::card::driver_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* text = ".version 7.0\n.visible .entry add(\n)\n";

class Card : public ::testing::Test {
 protected:
  // A library that is loaded already is used whenever one with its name is opened.
  Card()
      : library_(
            dlopen((test::build_dir() + "/tests/graphics_card/libcuda.so.1").c_str(), RTLD_NOW)) {
    if (!library_) throw std::runtime_error(dlerror());
    play("");
  }
  ~Card() override {
    EXPECT_EQ(held(), 0) << "something was not released";
    play("");
  }

  static void play(const char* words) { ::setenv("SINEW_FAKE_CARD", words, 1); }

  // Contexts, modules and buffers.
  long held() const { return reinterpret_cast<long (*)()>(dlsym(library_, "fake_card_holds"))(); }

  static std::string problem() {
    std::string out;
    EXPECT_THAT(list(out), IsEmpty());
    return out;
  }

  template <class Work>
  static std::string message(const Work& work) {
    try {
      work();
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "no failure";
  }

  void* library_;
};

std::vector<double> sums(Program& program, std::vector<double> a, std::vector<double> b) {
  int count = static_cast<int>(a.size());
  const std::size_t bytes = a.size() * sizeof(double);
  Buffer left(program, bytes), right(program, bytes), sum(program, bytes);
  left.write(std::as_bytes(std::span(a)));
  right.write(std::as_bytes(std::span(b)));
  void* parameters[] = {left.parameter(), right.parameter(), sum.parameter(), &count};
  program.launch((static_cast<unsigned>(count) + 31) / 32, 32, parameters);
  program.wait();
  std::vector<double> out(a.size());
  sum.read(std::as_writable_bytes(std::span(out)));
  return out;
}

TEST_F(Card, AKernelReadsAndWritesBuffers) {
  Program program(0, text, "add");
  EXPECT_THAT(sums(program, {1, 2, 3}, {10, 20, 30}), ElementsAre(11, 22, 33));
}

TEST_F(Card, EachUsableCardIsListedWithItsNumber) {
  play("cards=3 old-card memory=5000000000 multiprocessors=4");
  std::string problem;
  const std::vector<Properties> all = list(problem);
  EXPECT_EQ(problem, "");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].number, 1);
  EXPECT_EQ(all[0].name, "fake card 1");
  EXPECT_EQ(all[0].multiprocessors, 4);
  EXPECT_EQ(all[0].memory, 5'000'000'000);
  EXPECT_EQ(all[0].driver, "12.4");
  EXPECT_EQ(all[1].number, 2);
}

TEST_F(Card, TheReasonForNoCardIsGiven) {
  play("none");
  EXPECT_EQ(problem(), "the driver found none (CUDA_ERROR_NO_DEVICE, 100)");
  play("cards=0");
  EXPECT_EQ(problem(), "the driver found none");
  play("broken");
  EXPECT_EQ(problem(), "the driver does not start (CUDA_ERROR_UNKNOWN, 999)");
  play("old-driver");
  EXPECT_THAT(problem(), HasSubstr("supports CUDA 10.2; expected 11.0 or newer"));
  play("old-card");
  EXPECT_EQ(problem(), "fake card 0 has compute capability 7.5; expected 8.0 or newer");
  play("none");
  EXPECT_EQ(message([] { Program(0, text, "add"); }),
            "found no graphics card: the driver found none (CUDA_ERROR_NO_DEVICE, 100)");
}

TEST_F(Card, AFailureHasTheCallTheErrorAndWhatCanBeDone) {
  EXPECT_EQ(message([] { Program(1, text, "add"); }),
            "the graphics card failed: cuDeviceGet: CUDA_ERROR_INVALID_DEVICE, 101; take a card "
            "that `sinew doctor` lists, or use the processor, device=cpu");
  EXPECT_THAT(message([] { Program(0, text, "subtract"); }),
              HasSubstr("cuModuleGetFunction: CUDA_ERROR_NOT_FOUND, 500"));
  play("load");
  EXPECT_EQ(message([] { Program(0, text, "add"); }),
            "the graphics card failed: cuModuleLoadDataEx: CUDA_ERROR_INVALID_PTX, 218: ptxas "
            "application ptx input, line 7; error; install a newer driver, or use the processor, "
            "device=cpu");
}

TEST_F(Card, MemoryThatIsNotThereIsRefusedWithBothNumbers) {
  play("memory=3000000");
  const Program program(0, text, "add");
  {
    const Buffer held(program, 1'000'000);
    EXPECT_EQ(program.free_memory(), 2'000'000u);
    EXPECT_EQ(message([&] { Buffer(program, 2'000'001); }),
              "the graphics card failed: cuMemAlloc: CUDA_ERROR_OUT_OF_MEMORY, 2: 2.0 MB were "
              "requested, 2.0 MB are free; end other programs that use the card, or use the "
              "processor, device=cpu");
  }
  EXPECT_EQ(program.free_memory(), 3'000'000u);
}

TEST_F(Card, AFailedLaunchAndAFailedKernelAreReported) {
  Program program(0, text, "add");
  play("launch");
  EXPECT_THAT(message([&] { sums(program, {1}, {1}); }),
              HasSubstr("cuLaunchKernel: CUDA_ERROR_LAUNCH_OUT_OF_RESOURCES, 701"));
  play("wait");
  EXPECT_THAT(message([&] { sums(program, {1}, {1}); }),
              HasSubstr("cuCtxSynchronize: CUDA_ERROR_LAUNCH_FAILED, 719"));
  play("");
  EXPECT_THAT(message([&] { program.wait(); }), HasSubstr("719")) << "it remains failed";
  Program another(0, text, "add");
  EXPECT_THAT(sums(another, {1}, {1}), ElementsAre(2));
}

TEST_F(Card, MoreDataThanABufferHoldsIsRefused) {
  const Program program(0, text, "add");
  Buffer buffer(program, 8);
  std::vector<std::byte> bytes(9);
  EXPECT_THROW(buffer.write(bytes), std::invalid_argument);
  EXPECT_THROW(buffer.read(bytes), std::invalid_argument);
  EXPECT_EQ(Buffer(program, 0).size(), 0u);
}

TEST_F(Card, ThreadsShareAProgramOrHaveTheirOwn) {
  Program shared(0, text, "add");
  std::vector<std::thread> threads;
  std::vector<std::vector<double>> results(8);
  for (std::size_t i = 0; i < results.size(); ++i)
    threads.emplace_back([&, i] {
      const double x = static_cast<double>(i);
      for (int k = 0; k < 100; ++k) {
        if (i % 2 == 0) {
          results[i] = sums(shared, {x, x}, {1, 2});
        } else {
          Program own(0, text, "add");
          results[i] = sums(own, {x, x}, {1, 2});
        }
      }
    });
  for (std::thread& t : threads) t.join();
  for (std::size_t i = 0; i < results.size(); ++i) {
    const double x = static_cast<double>(i);
    EXPECT_THAT(results[i], ElementsAre(x + 1, x + 2));
  }
}

TEST_F(Card, MovedProgramsAndBuffersReleaseWhatTheyHeldOnce) {
  Program first(0, text, "add"), second(0, text, "add");
  Buffer of_second(second, 16), of_first(first, 8);
  EXPECT_EQ(held(), 2 * 2 + 2);
  second = std::move(first);
  EXPECT_EQ(held(), 2 * 2 + 2) << "a buffer keeps the memory of its program";
  of_second = Buffer(second, 32);
  EXPECT_EQ(of_second.size(), 32u);
  EXPECT_EQ(held(), 2 + 2);
  const Buffer last = std::move(of_first);
  EXPECT_EQ(last.size(), 8u);
  EXPECT_EQ(held(), 2 + 2);
  EXPECT_THAT(sums(second, {1}, {2}), ElementsAre(3));
}

}  // namespace
}  // namespace sinew::card::driver_test
