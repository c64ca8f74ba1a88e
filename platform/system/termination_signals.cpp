#include "platform/system/termination_signals.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <sys/signalfd.h>
#include <unistd.h>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

sigset_t termination_set() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    return set;
}

}  // namespace

TerminationSignals::TerminationSignals() {
    const sigset_t set = termination_set();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    descriptor_ = signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ < 0)
        throw Error(ExitStatus::unavailable, std::string("signalfd: ") + std::strerror(errno));
}

TerminationSignals::~TerminationSignals() {
    close(descriptor_);
    const sigset_t set = termination_set();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

bool TerminationSignals::arrived() {
    signalfd_siginfo info;
    if (read(descriptor_, &info, sizeof info) == static_cast<ssize_t>(sizeof info)) arrived_ = true;
    return arrived_;
}

}  // namespace touchstone
