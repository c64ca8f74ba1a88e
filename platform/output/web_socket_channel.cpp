#include "platform/output/web_socket_channel.hpp"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <fmt/core.h>
#include <libwebsockets.h>
#include <map>
#include <mutex>
#include <optional>
#include <sys/socket.h>
#include <thread>
#include <utility>

#include "platform/output/web_origin.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {
namespace {

constexpr std::size_t most_waiting = 64;      // bundles: two seconds of frames
constexpr int most_unsent_bytes = 32 * 1024;  // that the kernel keeps of one client
constexpr unsigned most_connections = 256;    // clients, and some files of the library's own
constexpr std::chrono::milliseconds farewell{200};

// A client that answers no ping is gone.
constexpr std::uint16_t ping_after_s = 10, hang_up_after_s = 20;

lws_retry_bo_t idle_policy() {
    lws_retry_bo_t policy{};
    policy.secs_since_valid_ping = ping_after_s;
    policy.secs_since_valid_hangup = hang_up_after_s;
    return policy;
}

/// Bytes of a message, and before them the room that the library writes its header into.
using Message = std::shared_ptr<std::string>;
using Messages = std::deque<Message>;

void append(Messages& messages, Message message) {
    if (messages.size() == most_waiting) messages.pop_front();
    messages.push_back(std::move(message));
}

void log_of_library(int, const char* line) {
    std::string text(line);
    while (text.ends_with('\n')) text.pop_back();
    log_debug("websocket: {}", text);
}

/// Of the page that connects; empty where it is no page, nothing where it is too long to be one.
std::optional<std::string> origin_of(lws* connection) {
    std::array<char, 256> origin{};
    const int length = lws_hdr_copy(connection, origin.data(), origin.size(), WSI_TOKEN_ORIGIN);
    if (length < 0) return std::nullopt;
    return origin.data();
}

struct ContextDeleter {
    void operator()(lws_context* context) const { lws_context_destroy(context); }
};

}  // namespace

class WebSocketChannel::Server {
  public:
    explicit Server(const WebSocketConfig& config) : allowed_origin_(config.origin) {
        lws_set_log_level(LLL_ERR | LLL_WARN, log_of_library);
        lws_context_creation_info info{};
        info.iface = config.host.c_str();
        info.port = config.port;
        info.protocols = protocols_.data();
        if (config.host.find(':') == std::string::npos) info.options = LWS_SERVER_OPTION_DISABLE_IPV6;
        info.options |= LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | LWS_SERVER_OPTION_EXPLICIT_VHOSTS |
                        LWS_SERVER_OPTION_NO_LWS_SYSTEM_STATES;
        info.user = this;
        info.vhost_name = "touchstone";
        info.fd_limit_per_thread = most_connections;
        info.retry_and_idle_policy = &idle_policy_;
        context_.reset(lws_create_context(&info));
        host_ = context_ ? lws_create_vhost(context_.get(), &info) : nullptr;
        if (host_ == nullptr) {
            throw Error(ExitStatus::unavailable,
                        fmt::format("websocket: {}:{} cannot be served: another program has the port, or the "
                                    "address is none of this machine; choose others: [websocket] host, port",
                                    config.host, config.port));
        }
        thread_ = std::thread([this] { serve(); });
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server() {
        {
            std::unique_lock lock(mutex_);
            all_sent_.wait_for(lock, farewell, [this] { return outbox_.empty() && is_idle_; });
            is_over_ = true;
        }
        lws_cancel_service(context_.get());
        thread_.join();
    }

    void post(Message message) {
        {
            const std::lock_guard lock(mutex_);
            append(outbox_, std::move(message));
        }
        lws_cancel_service(context_.get());
    }
    int port() const { return lws_get_vhost_listen_port(host_); }

  private:
    static int called(lws* connection, lws_callback_reasons reason, void* user, void* in, std::size_t size) {
        auto* server = static_cast<Server*>(lws_context_user(lws_get_context(connection)));
        switch (reason) {
            case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
                return server->is_welcome(connection) ? 0 : -1;
            case LWS_CALLBACK_ESTABLISHED:
                server->welcome(connection);
                return 0;
            case LWS_CALLBACK_CLOSED:
                server->clients_.erase(connection);
                return 0;
            case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
                server->hand_out();
                return 0;
            case LWS_CALLBACK_SERVER_WRITEABLE:
                return server->write_to(connection) ? 0 : -1;
            case LWS_CALLBACK_RECEIVE:
                return 0;
            default:
                return lws_callback_http_dummy(connection, reason, user, in, size);
        }
    }

    void serve() {
        while (!is_over()) {
            lws_service(context_.get(), 0);
            const bool idle =
                std::ranges::all_of(clients_, [](const auto& client) { return client.second.empty(); });
            const std::lock_guard lock(mutex_);
            is_idle_ = idle;
            if (idle && outbox_.empty()) all_sent_.notify_all();
        }
    }
    bool is_over() {
        const std::lock_guard lock(mutex_);
        return is_over_;
    }
    bool is_welcome(lws* connection) {
        const std::optional<std::string> origin = origin_of(connection);
        if (origin && may_listen(*origin, allowed_origin_)) return true;
        if (origin && *origin != refused_origin_) {
            log_warning("websocket: pages of {} may not listen; [websocket] origin names one that may",
                        *origin);
            refused_origin_ = *origin;
        }
        return false;
    }
    void welcome(lws* connection) {
        clients_[connection];
        const lws_sockfd_type socket = lws_get_socket_fd(connection);
        ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &most_unsent_bytes, sizeof most_unsent_bytes);
    }
    /// What was posted, to all clients.
    void hand_out() {
        Messages posted;
        {
            const std::lock_guard lock(mutex_);
            posted = std::exchange(outbox_, {});
            is_idle_ = false;
        }
        for (auto& [connection, waiting] : clients_) {
            for (const Message& message : posted) append(waiting, message);
            lws_callback_on_writable(connection);
        }
    }
    /// False where the connection is broken.
    bool write_to(lws* connection) {
        Messages& waiting = clients_[connection];
        if (waiting.empty()) return true;
        const Message message = waiting.front();
        waiting.pop_front();
        auto* payload = reinterpret_cast<unsigned char*>(message->data()) + LWS_PRE;
        const std::size_t size = message->size() - LWS_PRE;
        const int written = lws_write(connection, payload, size, LWS_WRITE_BINARY);
        if (!waiting.empty()) lws_callback_on_writable(connection);
        return written >= 0 && static_cast<std::size_t>(written) >= size;
    }

    const std::array<lws_protocols, 2> protocols_{{{"tuio", called, 0, 1024, 0, nullptr, 0}, {}}};
    const lws_retry_bo_t idle_policy_ = idle_policy();
    std::string allowed_origin_;
    std::string refused_origin_;        ///< that was said last
    std::map<lws*, Messages> clients_;  ///< of the thread, as all that it calls
    std::mutex mutex_;
    std::condition_variable all_sent_;
    Messages outbox_;
    bool is_idle_ = true;  ///< no client has anything waiting
    bool is_over_ = false;
    std::unique_ptr<lws_context, ContextDeleter> context_;
    lws_vhost* host_ = nullptr;  ///< of the context
    std::thread thread_;
};

WebSocketChannel::WebSocketChannel(const WebSocketConfig& config)
    : server_(std::make_unique<Server>(config)) {}

WebSocketChannel::~WebSocketChannel() = default;

std::size_t WebSocketChannel::largest_bundle() const { return 64 * 1024; }

void WebSocketChannel::send(const OscBundle& bundle) {
    server_->post(std::make_shared<std::string>(std::string(LWS_PRE, '\0') + osc_bytes(bundle)));
}

int WebSocketChannel::port() const { return server_->port(); }

}  // namespace touchstone
