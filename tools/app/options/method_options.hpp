// How diagrams are made.
#pragma once

#include <vector>

#include "app/options/command_line.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

/// The methods as choices of an option.
Choices<Method> method_choices();

/// Adds --method: what `method` is, unless it is given.
void add_method_option(Command& command, Method& method, const std::string& about);

/// Adds --metric, --neighbourhood and the waves of djfa.
void add_method_options(Command& command, MethodOptions& options);

/// Throws UsageError for options that only djfa has, if none of the methods is djfa.
void check_method_options(const Command& command, const std::vector<Method>& methods,
                          const MethodOptions& options);

}  // namespace vorocl::command
