#include "support/source_tree.h"

namespace aqc::test {

std::string sourceTree() {
  return AQC_SOURCE_TREE;
}

}  // namespace aqc::test
