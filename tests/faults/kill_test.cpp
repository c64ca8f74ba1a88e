// kill -9 at random moments of a process that saves again and again.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "platform/system/error.hpp"
#include "tests/faults/kept_things.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using namespace test;

/// Memory that a child shares with its parent.
struct Progress {
    std::atomic<int> begun{0}, done{0};

    static Progress* make() {
        void* const memory =
            mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        return new (memory) Progress;
    }
};

TEST(Kill, AtRandomMomentsLeavesTheOldOrTheNewState) {
    const TemporaryFolder folder;
    std::mt19937 random(9);
    Progress* const progress = Progress::make();
    const std::vector<KeptThing> things = kept_things();
    int within_a_save = 0;
    const int kills = times(100, 1000);
    for (int kill_number = 0; kill_number < kills; ++kill_number) {
        const KeptThing& thing = things[static_cast<std::size_t>(kill_number) % things.size()];
        const std::filesystem::path path = folder / thing.name;
        progress->begun = progress->done = 0;
        if (!std::filesystem::exists(path) || thing.load(path) > 1000) thing.save(path, 0);
        const int before = thing.load(path);
        const pid_t child = fork();
        if (child == 0) {
            for (int number = before + 1;; ++number) {
                progress->begun = number;
                thing.save(path, number);
                progress->done = number;
            }
        }
        std::this_thread::sleep_for(std::chrono::microseconds(500 + random() % 6000));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        const int begun = progress->begun, done = progress->done;
        within_a_save += begun > done;
        const int found = thing.load(path);
        ASSERT_TRUE(found == begun || found == (done == 0 ? before : done))
            << thing.name << ": " << found << " where " << done << " was saved and " << begun << " begun";
    }
    std::printf("%d kills, %d of them within a save\n", kills, within_a_save);
    EXPECT_GT(within_a_save, kills / 4) << "else this tells little";
    munmap(progress, sizeof(Progress));
}

}  // namespace
}  // namespace touchstone
