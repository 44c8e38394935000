// The operator's side: terminal, viewer, logs, documents, and how long a clone and a change take.
#include "bench/operator_figures.hpp"

namespace mrroc::bench {

Figures run_operator_group() {
  Figures all;
  for (const auto measure :
       {document_figures, viewer_figures, log_check_figures, latency_figures, clone_figures})
    for (Figure& f : measure()) all.push_back(std::move(f));
  return all;
}

}  // namespace mrroc::bench
