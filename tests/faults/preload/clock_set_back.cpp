// LD_PRELOAD: the clock of the machine is set back by a day, for everything in this process.
#include <cerrno>
#include <ctime>
#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/syscall.h>
#include <sys/time.h>

#include "tests/faults/preload/fault_switch.hpp"

namespace {

constexpr time_t a_day_s = 86'400;

time_t shift_s() { return fault_is_on() ? a_day_s : 0; }

/// Waits that end at a time of day would take the shown clock for the true one.
timespec true_time(timespec shown) {
    shown.tv_sec += shift_s();
    return shown;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
    const long result = syscall(SYS_clock_gettime, clock, time);
    if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) time->tv_sec -= shift_s();
    return static_cast<int>(result);
}

int gettimeofday(timeval* time, void*) noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    *time = {now.tv_sec, now.tv_nsec / 1000};
    return 0;
}

time_t time(time_t* result) noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    if (result != nullptr) *result = now.tv_sec;
    return now.tv_sec;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
    // The version that programs of today are linked with: dlsym's default would be that of 1998.
    static const auto next = reinterpret_cast<decltype(&pthread_cond_timedwait)>(
        dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2"));
    const timespec end = true_time(*until);
    return next(condition, mutex, &end);
}

int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* until) {
    static const auto next =
        reinterpret_cast<decltype(&pthread_timedjoin_np)>(dlsym(RTLD_NEXT, "pthread_timedjoin_np"));
    const timespec end = true_time(*until);
    return next(thread, result, &end);
}

int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* until) noexcept {
    static const auto next =
        reinterpret_cast<decltype(&pthread_mutex_timedlock)>(dlsym(RTLD_NEXT, "pthread_mutex_timedlock"));
    const timespec end = true_time(*until);
    return next(mutex, &end);
}

int sem_timedwait(sem_t* semaphore, const timespec* until) {
    static const auto next = reinterpret_cast<decltype(&sem_timedwait)>(dlsym(RTLD_NEXT, "sem_timedwait"));
    const timespec end = true_time(*until);
    return next(semaphore, &end);
}

}  // extern "C"
