// The options of the methods of the library, and the methods as choices of an option.
#pragma once

#include "app/options/options.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

/// Adds --metric, --neighbourhood and the waves of djfa.
void add_method_options(CLI::App& app, MethodOptions& options);

/// The methods as choices of an option.
Choices<Method> method_choices();

/// Throws UsageError for options that only djfa has, if none of the methods is djfa.
void check_method_options(const CLI::App& app, const MethodOptions& options, bool has_djfa);

}  // namespace vorocl::command
