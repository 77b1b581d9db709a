// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/core/random.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ADVERSARY_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define ADVERSARY_ADDRESS_SANITIZER
#endif

#ifdef ADVERSARY_ADDRESS_SANITIZER
extern "C" void __sanitizer_set_death_callback(void (*callback)());
extern "C" inline char const* __asan_default_options() { return "max_allocation_size_mb=256:hard_rss_limit_mb=1500"; }
#endif

/// Draws inputs for named games until their number or time is spent; every input has a seed of its own, so that one can
/// be played again.
namespace adversary {

enum class Outcome { accepted, refused };

/// What is tried against inputs drawn from random numbers.
struct Game {
  std::string name;
  std::function<Outcome(scarp::Random&)> play;  ///< throws for what must not be
};

struct Present {
  char game[64] = "";
  unsigned long long seed = 0;
  unsigned long long input = 0;
};
inline Present present;

/// Also called where a sanitizer ends the program: no memory is requested.
inline void tell_present() {
  char text[256];
  int const length = std::snprintf(text, sizeof text, "\nFOUND by --only '%s' --seed %llu --first %llu --inputs 1\n",
                                   present.game, present.seed, present.input);
  if (length > 0) static_cast<void>(!::write(2, text, static_cast<std::size_t>(length)));
}

inline void die(int signal) {
  tell_present();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Inputs end by themselves within seconds, and ask for no more memory than this.
inline void set_bounds() {
  for (int const signal : {SIGALRM, SIGABRT}) std::signal(signal, die);
#ifdef ADVERSARY_ADDRESS_SANITIZER
  __sanitizer_set_death_callback(tell_present);
#else
  for (int const signal : {SIGSEGV, SIGFPE, SIGBUS}) std::signal(signal, die);
  rlimit const bound{1ULL << 30U, 1ULL << 30U};
  setrlimit(RLIMIT_AS, &bound);
#endif
}

/// program --seed S [--inputs N | --seconds T] [--only GAME] [--first K]
/// N and T are for each game.
inline int contest(int count, char** words, std::vector<Game> const& games) {
  constexpr unsigned longest = 20;  // [s] of one input, with sanitizers on a busy machine
  std::uint64_t seed = 1;
  std::uint64_t inputs = 1000;
  std::uint64_t first = 0;
  double seconds = 0.0;
  std::string only;
  for (int k = 1; k + 1 < count; k += 2) {
    std::string_view const option = words[k];
    std::string const value = words[k + 1];
    if (option == "--seed")
      seed = std::stoull(value);
    else if (option == "--inputs")
      inputs = std::stoull(value);
    else if (option == "--first")
      first = std::stoull(value);
    else if (option == "--seconds")
      seconds = std::stod(value);
    else if (option == "--only")
      only = value;
    else
      return fmt::print(stderr, "unknown option '{}'\n", option), 2;
  }
  set_bounds();
  fmt::print("seed {}\n", seed);
  int found = 0;
  bool known = false;
  using Clock = std::chrono::steady_clock;
  for (auto const& game : games) {
    if (!only.empty() && game.name != only) continue;
    known = true;
    std::size_t const letters = game.name.copy(present.game, sizeof present.game - 1);
    present.game[letters] = '\0';
    present.seed = seed;
    std::uint64_t accepted = 0;
    std::uint64_t refused = 0;
    double slowest = 0.0;
    auto const started = Clock::now();
    auto const spent = [&] { return std::chrono::duration<double>(Clock::now() - started).count(); };
    for (std::uint64_t input = first; seconds > 0.0 ? spent() < seconds : input < first + inputs; ++input) {
      present.input = input;
      scarp::Random random(seed * 0x9e3779b97f4a7c15ULL + input);
      double const before = spent();
      alarm(longest);
      try {
        ++(game.play(random) == Outcome::accepted ? accepted : refused);
      } catch (std::exception const& wrong) {
        if (++found <= 20) {
          tell_present();
          fmt::print(stderr, "{}\n", std::string_view(wrong.what()).substr(0, 2000));
        }
      }
      alarm(0);
      slowest = std::max(slowest, spent() - before);
    }
    fmt::print("{}: {} inputs, {} accepted, {} refused, {:.1f} s, slowest {:.3f} s\n", game.name, accepted + refused,
               accepted, refused, spent(), slowest);
    std::fflush(stdout);
    if (accepted + refused >= 200 && accepted == 0) {
      fmt::print(stderr, "{}: nothing was accepted, so that nothing was tested\n", game.name);
      ++found;
    }
  }
  if (!known) return fmt::print(stderr, "there is no '{}'\n", only), 2;
  fmt::print("{} found\n", found);
  return found == 0 ? 0 : 1;
}

/// Ends the input as found.
inline void demand(bool holds, std::string_view what) {
  if (!holds) throw std::logic_error(std::string(what));
}

}  // namespace adversary
