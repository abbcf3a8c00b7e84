#pragma once

namespace comparisons::program {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM ask the run to end with what is there; the second
/// one ends the program at once. Files are renamed into place when complete, so neither leaves half
/// a file.
class Interrupt {
public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt &) = delete;
  Interrupt &operator=(const Interrupt &) = delete;

  static bool requested();
};

} // namespace comparisons::program
