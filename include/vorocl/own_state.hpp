// What an object of the library holds, of types that its headers do not show.
#pragma once

#include <memory>

namespace vorocl {

template <typename State>
struct StateDeleter {
  void (*destroy)(State*) = nullptr;
  void operator()(State* state) const { destroy(state); }
};

/// Owns the state of an object: it moves with it and has no copy. Null at first and after it was moved from.
template <typename State>
using OwnState = std::unique_ptr<State, StateDeleter<State>>;

}  // namespace vorocl
