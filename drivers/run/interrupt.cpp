// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/interrupt.hpp"
#include <csignal>

namespace drivers {
namespace {

volatile std::sig_atomic_t requested = 0;

void request(int signal) {
  requested = signal;
}

} // namespace

void listen_for_signals() {
  struct sigaction action {};
  action.sa_handler = request;
  action.sa_flags = int(SA_RESTART | SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    sigaction(signal, nullptr, &old);
    if (old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

int stop_requested() {
  return requested;
}

} // namespace drivers
