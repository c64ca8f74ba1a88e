#pragma once

#include <array>
#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

#include "platform/display/picture.hpp"

namespace touchstone::test {

/// An X server for this process and the programs it starts, ended with the object.
class XServer {
  public:
    /// `command` gets "-displayfd N", on which it says by which name it serves.
    explicit XServer(std::vector<std::string> command);
    ~XServer();
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;

    bool runs() const { return runs_; }

  private:
    pid_t process_ = -1;
    bool runs_ = false;
};

/// A window's number for X.
using XWindowId = unsigned long;

/// The first window of SDL in this process.
XWindowId window_of_sdl();

/// Looks at the screen of an X server, and does to its windows what a user or a window manager does.
class XView {
  public:
    XView();
    ~XView();

    /// What anybody who stands before the screen sees.
    Picture picture(int x, int y, int width, int height) const;
    /// x, y, width, height of a window on the screen.
    std::array<int, 4> place(XWindowId window) const;
    bool is_shown(XWindowId window) const;
    void resize(XWindowId window, int width, int height) const;
    /// As the button of a window's frame does.
    void ask_to_close(XWindowId window) const;
    void move_pointer(int x, int y) const;
    /// Whether anything is drawn where the pointer is.
    bool pointer_is_seen() const;
    /// Tells the owner of a window, and no other, that the server's output of that number was pulled out.
    void say_pulled_out(XWindowId window, int output) const;

  private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
};

}  // namespace touchstone::test
