#include "report/resources.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "report/flight_files.h"
#include "support/files.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

using Resources = test::InFolder;

TEST_F(Resources, AreFoundByNameAndByPath) {
  fs::create_directories(folder_ / "vehicle");
  for (const char* name : {"b.yaml", "a.yaml", "notes.txt"}) {
    writeFile((folder_ / "vehicle" / name).string(), "x");
  }
  const std::string config = folder_.string();
  EXPECT_EQ(resourceNames(config, "vehicle"), (std::vector<std::string>{"a", "b"}));
  const std::string file = (folder_ / "vehicle" / "a.yaml").string();
  EXPECT_EQ(findResource(config, "vehicle", "a"), file);
  EXPECT_EQ(findResource("", "vehicle", file), file);
  EXPECT_EQ(resourceName(file), "a");
  try {
    findResource(config, "vehicle", "c");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "unknown vehicle 'c'; there are: a, b");
  }
  EXPECT_THROW(findResource(config, "vehicle", ""), std::runtime_error);
  EXPECT_THROW(findResource(config, "vehicle", config + "/c.yaml"), std::runtime_error);
  EXPECT_THROW(findResource(config, "vehicle", config + "/vehicle"), std::runtime_error);
}

TEST_F(Resources, HoldScenariosInTheConfigFolder) {
  EXPECT_FALSE(resourceNames(configFolder(), "scenario").empty());
}

}  // namespace
}  // namespace aqc
