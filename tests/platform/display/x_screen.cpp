#include "tests/platform/display/x_screen.hpp"

#include <SDL.h>
#include <SDL_syswm.h>
#include <X11/Xutil.h>
#include <X11/extensions/Xfixes.h>
#include <X11/extensions/Xrandr.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace touchstone::test {

namespace {

[[noreturn]] void become(std::vector<std::string> command, int file) {
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    command.insert(command.end(), {"-displayfd", std::to_string(file)});
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

}  // namespace

XServer::XServer(std::vector<std::string> command) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return;
    process_ = fork();
    if (process_ == 0) become(std::move(command), ends[1]);
    close(ends[1]);
    std::string name = ":";
    for (char sign = 0; read(ends[0], &sign, 1) == 1 && sign != '\n';) name += sign;
    close(ends[0]);
    runs_ = name.size() > 1;
    if (!runs_) return;
    setenv("DISPLAY", name.c_str(), 1);
    setenv("SDL_VIDEODRIVER", "x11", 1);
}

XServer::~XServer() {
    unsetenv("DISPLAY");
    unsetenv("SDL_VIDEODRIVER");
    if (process_ <= 0) return;
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
}

XWindowId window_of_sdl() {
    SDL_SysWMinfo info;
    SDL_VERSION(&info.version);
    SDL_Window* window = nullptr;
    for (Uint32 id = 1; id < 100 && !window; ++id) window = SDL_GetWindowFromID(id);
    return window && SDL_GetWindowWMInfo(window, &info) ? info.info.x11.window : 0;
}

struct XView::Connection {
    ::Display* display = XOpenDisplay(nullptr);
    Window root = DefaultRootWindow(display);
    ~Connection() { XCloseDisplay(display); }

    XWindowAttributes attributes(Window window) const {
        XWindowAttributes result;
        XGetWindowAttributes(display, window, &result);
        return result;
    }
    void send_to(Window window, XEvent& event) const {
        XSendEvent(display, window, False, NoEventMask, &event);
        XSync(display, False);
    }
};

XView::XView() : connection_(std::make_unique<Connection>()) {}
XView::~XView() = default;

Picture XView::picture(int x, int y, int width, int height) const {
    XImage* image = XGetImage(connection_->display, connection_->root, x, y, static_cast<unsigned>(width),
                              static_cast<unsigned>(height), AllPlanes, ZPixmap);
    Picture picture{width, height, {}};
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const unsigned long pixel = XGetPixel(image, column, row);
            for (const int shift : {16, 8, 0})
                picture.rgba.push_back(static_cast<std::uint8_t>(pixel >> shift & 0xff));
            picture.rgba.push_back(255);
        }
    }
    XDestroyImage(image);
    return picture;
}

std::array<int, 4> XView::place(XWindowId window) const {
    const XWindowAttributes attributes = connection_->attributes(window);
    int x = 0, y = 0;
    Window child = 0;
    XTranslateCoordinates(connection_->display, window, connection_->root, 0, 0, &x, &y, &child);
    return {x, y, attributes.width, attributes.height};
}

bool XView::is_shown(XWindowId window) const {
    return connection_->attributes(window).map_state == IsViewable;
}

void XView::resize(XWindowId window, int width, int height) const {
    XResizeWindow(connection_->display, window, static_cast<unsigned>(width), static_cast<unsigned>(height));
    XSync(connection_->display, False);
}

void XView::ask_to_close(XWindowId window) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(connection_->display, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(connection_->display, "WM_DELETE_WINDOW", False));
    connection_->send_to(window, event);
}

void XView::move_pointer(int x, int y) const {
    XWarpPointer(connection_->display, None, connection_->root, 0, 0, 0, 0, x, y);
    XSync(connection_->display, False);
}

bool XView::pointer_is_seen() const {
    XFixesCursorImage* image = XFixesGetCursorImage(connection_->display);
    const int pixels = image->width * image->height;
    const bool seen =
        std::any_of(image->pixels, image->pixels + pixels, [](unsigned long p) { return p >> 24 != 0; });
    XFree(image);
    return seen;
}

void XView::say_pulled_out(XWindowId window, int output) const {
    int first_event = 0, first_error = 0;
    XRRQueryExtension(connection_->display, &first_event, &first_error);
    XRRScreenResources* resources = XRRGetScreenResourcesCurrent(connection_->display, connection_->root);
    XEvent event{};
    auto& change = reinterpret_cast<XRROutputChangeNotifyEvent&>(event);
    change.type = first_event + RRNotify;
    change.subtype = RRNotify_OutputChange;
    change.window = connection_->root;
    change.output = resources->outputs[output];
    change.connection = RR_Disconnected;
    XRRFreeScreenResources(resources);
    connection_->send_to(window, event);
}

}  // namespace touchstone::test
