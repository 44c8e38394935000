// The operator's side: terminal, viewer, logs, documents, and how long a clone and a change take.
#include <cstdio>

#include "bench/operator_figures.hpp"

namespace mrroc::bench {

Figures run_operator_group() {
  Figures all;
  for (const auto measure :
       {document_figures, viewer_figures, log_check_figures, latency_figures, clone_figures})
    for (Figure& f : measure()) {
      std::fprintf(stderr, "operator: %s %g %s\n", f.key.c_str(), f.value, f.unit.c_str());
      all.push_back(std::move(f));
    }
  return all;
}

}  // namespace mrroc::bench
