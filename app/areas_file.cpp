#include "app/areas_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <set>
#include <sstream>

#include "platform/system/atomic_file.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"
#include "platform/system/toml_text.hpp"

namespace touchstone {

namespace {

/// It becomes part of the name of a file.
bool is_name(const std::string& name) {
    constexpr std::size_t most = 40;
    return !name.empty() && name.size() <= most && name.find('/') == std::string::npos &&
           std::ranges::none_of(name, [](unsigned char letter) { return letter < ' ' || letter == 127; });
}

class Reader {
  public:
    explicit Reader(std::string file) : file_(std::move(file)) {}

    std::vector<NamedArea> read(const toml::table& content) const {
        for (const auto& [key, node] : content)
            if (key.str() != "area")
                refuse(node.source(), fmt::format("there is no key {}; there is [[area]]", key.str()));
        if (!content.contains("area")) refuse({}, "it needs at least one [[area]], or area = [] for none");
        std::vector<NamedArea> areas;
        const toml::array* list = content["area"].as_array();
        if (list == nullptr) refuse(content["area"].node()->source(), "area is a list of tables: [[area]]");
        std::set<std::string> names;
        for (const toml::node& node : *list) {
            if (!node.is_table()) refuse(node.source(), "area is a list of tables: [[area]]");
            areas.push_back(area_of(*node.as_table()));
            if (!names.insert(areas.back().name).second)
                refuse(node.source(), "two areas are called \"" + areas.back().name + "\"");
        }
        return areas;
    }

  private:
    [[noreturn]] void refuse(const toml::source_region& where, const std::string& what) const {
        refuse_toml(file_, where, what);
    }

    NamedArea area_of(const toml::table& table) const {
        NamedArea area;
        for (const auto& [key, node] : table) {
            if (key.str() == "name")
                area.name = text_of(node);
            else if (key.str() == "scene")
                area.scene = text_of(node);
            else if (key.str() == "source")
                area.source = text_of(node);
            else if (key.str() == "corners_mm")
                area.corners_mm = corners_of(node);
            else
                refuse(node.source(),
                       fmt::format("there is no key area.{}; there are name, scene, source, corners_mm",
                                   key.str()));
        }
        if (!is_name(area.name))
            refuse(table.source(), "an area needs a name of at most 40 bytes without slash or line end");
        if (const std::string fault = fault_of(area.corners_mm); !fault.empty())
            refuse(table.source(), fault);
        return area;
    }
    std::string text_of(const toml::node& node) const {
        const auto text = node.value<std::string>();
        if (!text) refuse(node.source(), "this is a text in quotes");
        return *text;
    }
    Polygon corners_of(const toml::node& node) const {
        Polygon corners;
        const toml::array* list = node.as_array();
        if (list == nullptr) refuse(node.source(), "corners_mm is a list of [x, y]");
        for (const toml::node& corner : *list) {
            const toml::array* pair = corner.as_array();
            if (pair == nullptr || pair->size() != 2)
                refuse(corner.source(), "a corner is [x, y] in millimetres");
            corners.emplace_back(number_of(*pair->get(0)), number_of(*pair->get(1)));
        }
        return corners;
    }
    float number_of(const toml::node& node) const {
        constexpr double most_mm = 10000.0;
        const auto number = node.value<double>();
        if (!number || !(std::abs(*number) <= most_mm))
            refuse(node.source(), "a corner is [x, y] in millimetres, from -10000 to 10000");
        return static_cast<float>(*number);
    }

    std::string file_;
};

std::vector<NamedArea> read(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw Error(ExitStatus::no_input, "cannot read the areas " + path.string());
    std::ostringstream text;
    text << file.rdbuf();
    return parse_areas(text.str(), path.string());
}

bool is_whole(const std::filesystem::path& path) {
    try {
        (void)read(path);
        return true;
    } catch (const Error&) {
        return false;
    }
}

Previous what_becomes_of_previous(const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::exists(path, none)) return Previous::removed;
    const bool would_lose_the_last = !is_whole(path) && is_whole(previous_of(path));
    return would_lose_the_last ? Previous::untouched : Previous::kept;
}

std::string quoted(const std::string& text) {
    std::ostringstream out;
    out << toml::value<std::string>(text);
    return out.str();
}

}  // namespace

std::vector<NamedArea> parse_areas(std::string_view text, const std::string& name) {
    return Reader(name).read(parse_toml(text, name));
}

std::vector<NamedArea> load_areas(const std::filesystem::path& path) {
    try {
        return read(path);
    } catch (const Error& error) {
        if (error.status() != ExitStatus::configuration || !is_whole(previous_of(path))) throw;
        log_warning("{}; the areas before it count", error.what());
        return read(previous_of(path));
    }
}

void save_areas(const std::filesystem::path& path, const std::vector<NamedArea>& areas) {
    std::string text =
        "# Areas of the table. Millimetres on its main plane from the middle of the camera's view, x to the "
        "right, y "
        "down.\n";
    if (areas.empty()) text += "area = []\n";
    for (const NamedArea& area : areas) {
        text += "\n[[area]]\nname = " + quoted(area.name) + "\n";
        if (!area.scene.empty()) text += "scene = " + quoted(area.scene) + "\n";
        if (!area.source.empty()) text += "source = " + quoted(area.source) + "\n";
        text += "corners_mm = [";
        for (std::size_t i = 0; i < area.corners_mm.size(); ++i)
            text += fmt::format("{}[{:.1f}, {:.1f}]", i > 0 ? ", " : "", area.corners_mm[i].x(),
                                area.corners_mm[i].y());
        text += "]\n";
    }
    write_file_atomically(path, text, what_becomes_of_previous(path));
}

}  // namespace touchstone
