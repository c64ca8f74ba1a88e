#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

/// Breaches of a house rule, one a line: file, line number, what is wrong.
using Breaches = std::vector<std::string>;

/// Includes between the folders app, platform, pipeline, ui and kernels that do not follow the arrows of the
/// design.
Breaches include_direction_breaches(const std::filesystem::path& root);

/// What kernels must not use: images, half, double, subgroups, OpenCL 2, groups of more than 256 work-items.
Breaches kernel_language_breaches(const std::filesystem::path& root);

/// Sources and kernels outside tests with more lines than `most`.
Breaches file_length_breaches(const std::filesystem::path& root, std::size_t most);

/// Sources of the tree with one of the endings, in order; folders build and node_modules are left out.
std::vector<std::filesystem::path> source_files(const std::filesystem::path& root,
                                                const std::vector<std::string_view>& folders,
                                                const std::vector<std::string_view>& endings);

}  // namespace touchstone
