// A plugin of Oclgrind that counts what warps of 32 work-items would execute on a GPU. Each 32 neighbouring
// items of a group are replayed in lock step. Of lanes at different places those at the earliest one go first
// (before others that have passed more barriers, in the deepest call, by the order of basic blocks), so that
// lanes meet again behind branches, loops and barriers. It counts the instructions of LLVM's intermediate
// code that warps issue and how many of their lanes take part. An operation on a vector counts once for each
// of its lanes, a load or store once for each four of them.
//
// WARPS_EVERY=N counts one work-group in N, and prints estimates of all.
#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>
#include <oclgrind/Context.h>
#include <oclgrind/Kernel.h>
#include <oclgrind/KernelInvocation.h>
#include <oclgrind/Memory.h>
#include <oclgrind/Plugin.h>
#include <oclgrind/WorkGroup.h>
#include <oclgrind/WorkItem.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

using namespace oclgrind;

namespace {

constexpr std::size_t warp = 32;
constexpr unsigned private_memory = 0, global_memory = 1;

struct Access {
  std::uint64_t address;
  std::size_t size;
  unsigned space;
};

/// What a lane executes from a place on, until the next branch, call, return or barrier.
struct Step {
  std::uint32_t barriers, depth, place;
  std::uint32_t weight;  // instructions
  std::size_t first_access, accesses;

  /// Steps of several lanes with one order are one step of their warp; the least goes first.
  auto order() const { return std::make_tuple(barriers, ~depth, place); }
};

struct Lane {
  std::vector<Step> steps;
  std::vector<Access> accesses;
  std::uint32_t depth = 0, barriers = 0;
  bool starts_step = true;
};

/// Of one launch.
struct Counts {
  std::uint64_t groups = 0, counted_groups = 0, warps = 0, issued = 0, active = 0, most = 0;
  std::uint64_t private_requests = 0, global_requests = 0, global_sectors = 0, atomics = 0;
};

int lanes_of(const llvm::Type* type) {
  const auto* vector = llvm::dyn_cast<llvm::FixedVectorType>(type);
  return vector != nullptr ? static_cast<int>(vector->getNumElements()) : 1;
}

/// The instructions that a GPU has for one of the intermediate code.
std::uint32_t weight_of(const llvm::Instruction& i) {
  using namespace llvm;
  if (isa<PHINode>(i) || isa<BitCastInst>(i) || isa<AllocaInst>(i) || isa<InsertElementInst>(i) ||
      isa<ExtractElementInst>(i) || isa<ShuffleVectorInst>(i) || isa<DbgInfoIntrinsic>(i) ||
      isa<ZExtInst>(i) || isa<SExtInst>(i) || isa<TruncInst>(i) || isa<ReturnInst>(i) ||
      i.isLifetimeStartOrEnd()) {
    return 0;
  }
  const auto of_memory = [](const Type* type) {
    return static_cast<std::uint32_t>(std::max(lanes_of(type) / 4, 1));
  };
  if (const auto* store = dyn_cast<StoreInst>(&i)) return of_memory(store->getValueOperand()->getType());
  if (isa<LoadInst>(i)) return of_memory(i.getType());
  if (const auto* branch = dyn_cast<BranchInst>(&i)) return branch->isConditional() ? 1 : 0;
  if (isa<GetElementPtrInst>(i)) return 1;
  if (isa<CmpInst>(i)) return static_cast<std::uint32_t>(lanes_of(i.getOperand(0)->getType()));
  return static_cast<std::uint32_t>(lanes_of(i.getType()));
}

class Warps : public Plugin {
 public:
  explicit Warps(const Context* context) : Plugin(context) {
    if (const char* const every = std::getenv("WARPS_EVERY")) every_ = std::strtoull(every, nullptr, 10);
  }
  bool isThreadSafe() const override { return false; }

  void workGroupBegin(const WorkGroup* group) override {
    is_counting_ = counts_.groups++ % every_ == 0;
    if (!is_counting_) return;
    ++counts_.counted_groups;
    size_ = group->getGroupSize();
    lanes_.assign(size_.x * size_.y * size_.z, Lane());
  }

  void instructionExecuted(const WorkItem* item, const llvm::Instruction* i, const TypedValue&) override {
    if (!is_counting_) return;
    Lane& lane = lane_of(item);
    step_of(lane, i).weight += weight_of(*i);
    if (const auto* const call = llvm::dyn_cast<llvm::CallInst>(i)) {
      const llvm::Function* const function = call->getCalledFunction();
      if (function != nullptr && !function->isDeclaration()) {
        ++lane.depth;
        lane.starts_step = true;
      } else if (function != nullptr && function->getName().contains("barrier")) {
        ++lane.barriers;
        lane.starts_step = true;
      }
    } else if (llvm::isa<llvm::ReturnInst>(i)) {
      --lane.depth;
      lane.starts_step = true;
    } else if (i->isTerminator()) {
      lane.starts_step = true;
    }
  }

  void memoryLoad(const Memory* memory, const WorkItem* item, size_t address, size_t size) override {
    access(memory, item, address, size);
  }
  void memoryStore(const Memory* memory, const WorkItem* item, size_t address, size_t size,
                   const uint8_t*) override {
    access(memory, item, address, size);
  }
  void memoryAtomicStore(const Memory* memory, const WorkItem* item, AtomicOp, size_t address,
                         size_t size) override {
    if (is_counting_) ++counts_.atomics;
    access(memory, item, address, size);
  }

  void workGroupComplete(const WorkGroup*) override {
    if (!is_counting_) return;
    for (std::size_t first = 0; first < lanes_.size(); first += warp) {
      replay(first, std::min(first + warp, lanes_.size()));
    }
  }

  void kernelEnd(const KernelInvocation* kernel) override {
    const Counts& c = counts_;
    const double share =
        c.counted_groups > 0 ? static_cast<double>(c.groups) / static_cast<double>(c.counted_groups) : 0;
    const auto all = [share](std::uint64_t counted) { return static_cast<double>(counted) * share; };
    std::printf(
        "%-28s %9.0f warps %12.0f instructions %10lu at most in a warp %5.1f active lanes "
        "%9.0f private %9.0f global requests %9.0f sectors %9.0f atomics\n",
        kernel->getKernel()->getName().c_str(), all(c.warps), all(c.issued), c.most,
        c.issued > 0 ? static_cast<double>(c.active) / static_cast<double>(c.issued) : 0.,
        all(c.private_requests), all(c.global_requests), all(c.global_sectors), all(c.atomics));
    counts_ = Counts();
  }

 private:
  Lane& lane_of(const WorkItem* item) {
    const Size3 id = item->getLocalID();
    return lanes_[(id.z * size_.y + id.y) * size_.x + id.x];
  }

  Step& step_of(Lane& lane, const llvm::Instruction* i) {
    if (lane.starts_step) {
      lane.steps.push_back({lane.barriers, lane.depth, place_of(i), 0, lane.accesses.size(), 0});
      lane.starts_step = false;
    }
    return lane.steps.back();
  }

  void access(const Memory* memory, const WorkItem* item, size_t address, size_t size) {
    const unsigned space = memory->getAddressSpace();
    if (!is_counting_ || (space != private_memory && space != global_memory)) return;
    Lane& lane = lane_of(item);
    ++step_of(lane, item->getCurrentInstruction()).accesses;
    lane.accesses.push_back({address, size, space});
  }

  /// A number for an instruction that orders those of a function as its blocks come in reverse post-order.
  std::uint32_t place_of(const llvm::Instruction* i) {
    const llvm::Function* const function = i->getFunction();
    const auto found = places_.find(i);
    if (found != places_.end()) return found->second;
    auto number = static_cast<std::uint32_t>(places_.size());  // none is of another function too
    for (const llvm::BasicBlock* block : llvm::ReversePostOrderTraversal<const llvm::Function*>(function)) {
      for (const llvm::Instruction& instruction : *block) places_[&instruction] = number++;
    }
    return places_.at(i);
  }

  void replay(std::size_t first, std::size_t end) {
    std::vector<std::size_t> next(end - first, 0);
    std::uint64_t issued = 0;
    while (true) {
      const Step* earliest = nullptr;
      for (std::size_t l = first; l < end; ++l) {
        const std::vector<Step>& steps = lanes_[l].steps;
        if (next[l - first] == steps.size()) continue;
        const Step& step = steps[next[l - first]];
        if (earliest == nullptr || step.order() < earliest->order()) earliest = &step;
      }
      if (earliest == nullptr) break;
      const auto order = earliest->order();
      std::vector<std::pair<const Lane*, const Step*>> here;
      for (std::size_t l = first; l < end; ++l) {
        const std::vector<Step>& steps = lanes_[l].steps;
        if (next[l - first] == steps.size() || steps[next[l - first]].order() != order) continue;
        here.emplace_back(&lanes_[l], &steps[next[l - first]++]);
      }
      std::uint32_t weight = 0;
      for (const auto& [lane, step] : here) weight = std::max(weight, step->weight);
      issued += weight;
      counts_.active += std::uint64_t{weight} * here.size();
      count_requests(here);
    }
    ++counts_.warps;
    counts_.issued += issued;
    counts_.most = std::max(counts_.most, issued);
  }

  /// The requests of a step to memory: a global one takes a sector for each 32 bytes that some lane wants.
  void count_requests(const std::vector<std::pair<const Lane*, const Step*>>& here) {
    std::size_t most = 0;
    for (const auto& [lane, step] : here) most = std::max(most, step->accesses);
    for (std::size_t number = 0; number < most; ++number) {
      std::set<std::uint64_t> sectors;
      bool is_global = false;
      for (const auto& [lane, step] : here) {
        if (number >= step->accesses) continue;
        const Access& access = lane->accesses[step->first_access + number];
        is_global = access.space == global_memory;
        constexpr std::uint64_t bytes = 32;
        for (std::uint64_t at = access.address / bytes; at <= (access.address + access.size - 1) / bytes;
             ++at)
          sectors.insert(at);
      }
      ++(is_global ? counts_.global_requests : counts_.private_requests);
      if (is_global) counts_.global_sectors += sectors.size();
    }
  }

  std::uint64_t every_ = 1;
  bool is_counting_ = false;
  Size3 size_;
  Counts counts_;
  std::vector<Lane> lanes_;
  std::unordered_map<const llvm::Instruction*, std::uint32_t> places_;
};

Warps* plugin = nullptr;

}  // namespace

extern "C" void initializePlugins(Context* context) {
  plugin = new Warps(context);
  context->registerPlugin(plugin);
}
extern "C" void releasePlugins(Context* context) {
  context->unregisterPlugin(plugin);
  delete plugin;
}
