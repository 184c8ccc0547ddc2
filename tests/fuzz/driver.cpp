// The driver runs a target without libFuzzer, by any compiler: every file of a corpus, then changed ones for
// a while. It takes [--seconds N] [--seed S] [--dictionary FILE] FILE|FOLDER... An input fails that crashes,
// hangs, or ends otherwise than by an error of the project's own. Its bytes are written to `fuzz-found`, and
// the file is named. The exit code is 1.
#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/mutate.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace voxmelt::fuzz {
namespace {

// The limit for one input is in the processor's time: other programs on the machine do not count.
#ifdef VOXMELT_SANITIZED
constexpr int kMostSeconds = 200;
#else
constexpr int kMostSeconds = 20;
#endif

// The handler of signals needs the input that is being tried. Nothing allocates there, and only system calls
// are made.
const std::string* g_input = nullptr;
const char* g_name = "";

void write_all(int file, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(file, bytes, size);
    if (written <= 0) return;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void say(const char* text) { write_all(STDERR_FILENO, text, std::strlen(text)); }

void keep(int signal) {
  std::signal(signal, SIG_DFL);
  const int file = open("fuzz-found", O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file >= 0 && g_input != nullptr) write_all(file, g_input->data(), g_input->size());
  say(g_name);
  say(signal == SIGPROF ? ": an input takes too long" : ": an input ends the program");
  say("; its bytes are in fuzz-found\n");
  std::_Exit(1);
}

// SIGPROF comes after so much time of the processor; 0 stops the clock.
void limit(int seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

void try_one(const std::string& input) {
  g_input = &input;
  limit(kMostSeconds);
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", g_name, error.what());
    keep(SIGABRT);
  }
  limit(0);
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
    std::exit(2);
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> corpus_of(const std::vector<std::filesystem::path>& places) {
  std::vector<std::filesystem::path> files;
  for (const auto& place : places) {
    if (!std::filesystem::is_directory(place)) {
      files.push_back(place);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(place))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> corpus;
  corpus.reserve(files.size());
  for (const auto& file : files) corpus.push_back(contents(file));
  return corpus;
}

int run(const std::vector<std::string>& arguments) {
  double seconds = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> words;
  std::vector<std::filesystem::path> places;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--seconds" && i + 1 < arguments.size())
      seconds = std::stod(arguments[++i]);
    else if (arguments[i] == "--seed" && i + 1 < arguments.size())
      seed = std::stoull(arguments[++i]);
    else if (arguments[i] == "--dictionary" && i + 1 < arguments.size())
      words = dictionary(contents(arguments[++i]));
    else
      places.emplace_back(arguments[i]);
  }
  const std::vector<std::string> corpus = corpus_of(places);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: the corpus is empty\n", g_name);
    return 2;
  }
  for (const std::string& input : corpus) try_one(input);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  Mutator mutator(corpus, words, seed);
  std::int64_t tried = 0;
  for (; std::chrono::steady_clock::now() < end; ++tried) try_one(mutator.next());
  std::printf("%s: %zu files, %lld changed ones\n", g_name, corpus.size(), static_cast<long long>(tried));
  return 0;
}

}  // namespace
}  // namespace voxmelt::fuzz

int main(int argc, char** argv) {
  using namespace voxmelt::fuzz;
  g_name = argv[0];
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPROF}) std::signal(signal, keep);
  // After a stack overflow there is no room for a handler, so that it gets a stack of its own.
  static std::array<char, 1 << 16> stack;
  stack_t own{};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  sigaltstack(&own, nullptr);
  struct sigaction action {};
  action.sa_handler = keep;
  action.sa_flags = SA_ONSTACK;
  sigaction(SIGSEGV, &action, nullptr);
  return run({argv + 1, argv + argc});
}
