#pragma once

#include <string>

#include "tests/accuracy/evaluation.hpp"

namespace touchstone {

/// The heads of the tables, for Markdown.
std::string contact_head();
std::string ghost_head();
std::string hover_head();

/// One row: how a method finds the contacts of the sequences that `what` names.
std::string contact_row(const std::string& what, const MethodSeries& method);
/// One row: what a method reports where nothing touches.
std::string ghost_row(const std::string& what, const MethodSeries& method);
/// One row: from which height on a method tells hovering fingers from touching ones.
std::string hover_row(const std::string& what, const MethodSeries& method);

}  // namespace touchstone
