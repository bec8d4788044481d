// What may have been meant by a word that is unknown.
#pragma once

#include <string>
#include <vector>

namespace vorocl::command {

/// "did you mean NAME? ", of the name that takes the fewest letters to insert, remove, replace or swap (the
/// distance of Damerau and Levenshtein, the first of several); nothing if more than a third of the word would
/// change.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

}  // namespace vorocl::command
