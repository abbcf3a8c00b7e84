#include "comparisons/program/interrupt.h"

#include <csignal>

namespace comparisons::program {

namespace {

// Signal handlers can only reach static storage; this is the one such variable of the program.
volatile std::sig_atomic_t signal_received = 0;

void handle(int signal) {
  if (signal_received != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  signal_received = 1;
}

} // namespace

Interrupt::Interrupt() {
  signal_received = 0;
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interrupt::requested() { return signal_received != 0; }

} // namespace comparisons::program
