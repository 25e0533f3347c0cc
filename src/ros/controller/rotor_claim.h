#pragma once

#include <string>

namespace aqc {

/// Throws std::runtime_error, naming it, when another living node publishes on `topic` (resolved)
/// already: two controllers on the same rotors fight. A node that died without a word is still
/// registered at the master; it does not answer, and does not count. Asks the master and each
/// publisher, so it may take as long as they do; a master that does not answer is no obstacle.
/// Two nodelets in one manager are one node: it does not tell them apart.
void requireSolePublisher(const std::string& topic);

}  // namespace aqc
