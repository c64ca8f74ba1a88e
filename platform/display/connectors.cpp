#include "platform/display/connectors.hpp"

#include <algorithm>
#include <cctype>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <unistd.h>
#include <xf86drmMode.h>

namespace touchstone {

namespace {

namespace fs = std::filesystem;

/// "HDMI-A-1" of "card0-HDMI-A-1"; empty for what is no connector.
std::string connector_name(const std::string& folder) {
    const std::size_t dash = folder.find('-');
    if (!folder.starts_with("card") || dash == std::string::npos) return {};
    return folder.substr(dash + 1);
}

std::vector<PixelSize> read_sizes(const fs::path& file) {
    std::vector<PixelSize> sizes;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        // An "i" at its end says interlaced.
        const auto mode = parse_screen_mode(line.substr(0, line.find('i')));
        if (mode && std::ranges::find(sizes, mode->size) == sizes.end()) sizes.push_back(mode->size);
    }
    return sizes;
}

std::string read_model(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    return model_of_edid({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

Connector read_connector(const fs::path& folder) {
    Connector connector{connector_name(folder.filename().string()), read_model(folder / "edid"), false,
                        read_sizes(folder / "modes")};
    std::string status;
    std::ifstream(folder / "status") >> status;
    connector.connected = status == "connected";
    return connector;
}

/// Names of a card's connectors as it counts them.
std::vector<std::string> names_on_card(const fs::path& card) {
    std::vector<std::string> names;
    const int file = open(card.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) return names;
    using Resources = std::unique_ptr<drmModeRes, decltype(&drmModeFreeResources)>;
    using DrmConnector = std::unique_ptr<drmModeConnector, decltype(&drmModeFreeConnector)>;
    const Resources resources(drmModeGetResources(file), &drmModeFreeResources);
    for (int i = 0; resources && i < resources->count_connectors; ++i) {
        const DrmConnector connector(drmModeGetConnectorCurrent(file, resources->connectors[i]),
                                     &drmModeFreeConnector);
        const char* type = connector ? drmModeGetConnectorTypeName(connector->connector_type) : nullptr;
        if (type) names.push_back(std::string(type) + "-" + std::to_string(connector->connector_type_id));
    }
    close(file);
    return names;
}

std::vector<fs::path> cards_in(const fs::path& dri) {
    std::vector<fs::path> cards;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(dri, none))
        if (entry.path().filename().string().starts_with("card")) cards.push_back(entry.path());
    std::ranges::sort(cards);
    return cards;
}

bool is_number(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// DP-1 is no word of eDP-1.
bool has_word(const std::string& text, const std::string& word) {
    const std::size_t at = text.find(word);
    return !word.empty() && at != std::string::npos &&
           (at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1])));
}

}  // namespace

std::vector<Connector> list_connectors(const fs::path& drm) {
    std::vector<Connector> connectors;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(drm, none))
        if (!connector_name(entry.path().filename().string()).empty())
            connectors.push_back(read_connector(entry.path()));
    std::ranges::sort(connectors, {}, &Connector::name);
    return connectors;
}

bool is_connected(const std::string& connector, const fs::path& drm) {
    const std::vector<Connector> all = list_connectors(drm);
    const auto found = std::ranges::find(all, connector, &Connector::name);
    return found != all.end() && found->connected;
}

std::vector<Connector> in_card_order(std::vector<Connector> connectors, const fs::path& dri) {
    std::erase_if(connectors, [](const Connector& connector) { return !connector.connected; });
    std::vector<std::string> order;
    for (const fs::path& card : cards_in(dri))
        std::ranges::copy(names_on_card(card), std::back_inserter(order));
    std::ranges::stable_sort(connectors, {}, [&](const Connector& connector) {
        return std::ranges::find(order, connector.name) - order.begin();
    });
    return connectors;
}

std::string model_of_edid(std::span<const std::uint8_t> edid) {
    constexpr std::size_t first = 54, length = 18, descriptors = 4, text = 5;
    for (std::size_t i = 0; i < descriptors; ++i) {
        const std::size_t at = first + i * length;
        if (edid.size() < at + length || edid[at] != 0 || edid[at + 1] != 0 || edid[at + 3] != 0xfc) continue;
        std::string name;
        for (const std::uint8_t sign : edid.subspan(at + text, length - text)) {
            if (sign < ' ' || sign > '~') break;
            name += static_cast<char>(sign);
        }
        name.erase(name.find_last_not_of(' ') + 1);
        return name;
    }
    return {};
}

std::vector<Output> named_after_connectors(std::vector<Output> outputs, std::vector<Connector> connectors) {
    const std::vector<Connector> all = connectors;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        std::string& name = outputs[i].name;
        if (is_number(name)) {
            if (i < all.size()) name = all[i].name + (all[i].model.empty() ? "" : " " + all[i].model);
            continue;
        }
        const auto is_in_name = [&](const std::string& word) { return has_word(name, word); };
        auto match = std::ranges::find_if(connectors, is_in_name, &Connector::name);
        if (match == connectors.end()) {
            match = std::ranges::find_if(connectors, is_in_name, &Connector::model);
            if (match != connectors.end()) name = match->name + " " + name;
        }
        // Of two projectors of one model each gets its own.
        if (match != connectors.end()) connectors.erase(match);
    }
    return outputs;
}

std::vector<Output> outputs_of(std::span<const Connector> connectors) {
    std::vector<Output> outputs;
    for (const Connector& connector : connectors) {
        if (!connector.connected) continue;
        Output output{connector.name + (connector.model.empty() ? "" : " " + connector.model), {}, {}};
        for (const PixelSize size : connector.sizes) output.modes.push_back({size, 0});
        if (!output.modes.empty()) output.own = output.modes.front();
        outputs.push_back(output);
    }
    return outputs;
}

std::string console_problem(const fs::path& dri, const fs::path& drm) {
    const std::vector<fs::path> cards = cards_in(dri);
    if (cards.empty())
        return "there is no " + (dri / "card*").string() +
               ": no driver of a graphics card is loaded (Raspberry Pi: dtoverlay=vc4-kms-v3d)";
    const bool may_open = std::ranges::any_of(
        cards, [](const fs::path& card) { return access(card.c_str(), R_OK | W_OK) == 0; });
    if (!may_open)
        return cards.front().string() +
               " may not be opened by this user: sudo usermod -aG video,render $USER, then log in anew";
    const std::vector<Connector> connectors = list_connectors(drm);
    if (std::ranges::none_of(connectors, &Connector::connected))
        return "no screen or projector is connected: connect one and switch it on";
    return {};
}

}  // namespace touchstone
