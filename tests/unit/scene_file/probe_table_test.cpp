// Tables of points as spreadsheets of several countries write them.
#include "json/input_file.hpp"
#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

/// The answers of 12.5 at each point of this table, as a table.
std::string answered(const std::string& table, std::vector<Probe>* probes = nullptr) {
  const TemporaryFolder folder;
  const ProbeFile file = read_probes(folder.write("points.csv", table));
  if (probes != nullptr) *probes = file.probes;
  const std::vector<ProbeAnswer> answers(
      file.probes.size(), {Spectrum{12.5}, Spectrum{0.5}, {}, {{"desk; left", Spectrum{2.5}}}});
  write_probe_answers(file, folder.file("answers.csv"), answers, "gather",
                      ExitanceUnit::lumen_per_m2);
  return read_text(folder.file("answers.csv"));
}

TEST(ProbeTableFile, KeepsItsSeparatorAndDecimalSign) {
  std::vector<Probe> probes;
  EXPECT_EQ(answered("x;y;z;who\n1,5;2;0,75;\"a; b\"\n", &probes),
            "x;y;z;who;E;error;unit;from;\"E by desk; left\"\n"
            "1,5;2;0,75;\"a; b\";12,5;0,5;lx;gather;2,5\n");
  EXPECT_EQ(probes[0].p, Vec3(1.5, 2, 0.75));
  EXPECT_EQ(answered("sep=;\r\nx;y;z\r\n1,5;2;0,75\r\n"),
            "x;y;z;E;error;unit;from;\"E by desk; left\"\n1,5;2;0,75;12,5;0,5;lx;gather;2,5\n");
  EXPECT_EQ(
      answered("sep=\t\nx\ty\tz\n1.5\t2\t0.75\n"),
      "x\ty\tz\tE\terror\tunit\tfrom\tE by desk; left\n1.5\t2\t0.75\t12.5\t0.5\tlx\tgather\t2.5\n");
  EXPECT_EQ(answered("# points\n1.5;2;0.75\n"),
            "x;y;z;E;error;unit;from;\"E by desk; left\"\n1.5;2;0.75;12.5;0.5;lx;gather;2.5\n");
  EXPECT_EQ(answered("x\ty\tz\n1.5\t2\t0.75\n", &probes),
            "x\ty\tz\tE\terror\tunit\tfrom\tE by desk; left\n"
            "1.5\t2\t0.75\t12.5\t0.5\tlx\tgather\t2.5\n");
  EXPECT_EQ(probes[0].p, Vec3(1.5, 2, 0.75));
  EXPECT_EQ(
      answered("x,y,z,\"a;b\"\n1.5,2,0.75,c\n"),
      "x,y,z,\"a;b\",E,error,unit,from,E by desk; left\n1.5,2,0.75,c,12.5,0.5,lx,gather,2.5\n");
}

TEST(ProbeTableFile, ASemicolonInATextOrTabsBehindCommasSeparateNothing) {
  std::vector<Probe> probes;
  answered("1.0,2.0,0.75,desk; left\n", &probes);
  EXPECT_EQ(probes[0].p, Vec3(1, 2, 0.75));
  answered("x,\ty,\tz\n1.0,\t2.0,\t0.75\n", &probes);
  EXPECT_EQ(probes[0].p, Vec3(1, 2, 0.75));
}

TEST(ProbeTableFile, TwoDecimalSignsAreRefused) {
  for (const char* table : {"x;y;z\n1,234;0.75;0,5\n", "1.5;2;0\n1,5;2;0\n"}) {
    const TemporaryFolder folder;
    const std::string path = folder.write("points.csv", table);
    try {
      read_probes(path);
      ADD_FAILURE() << table;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("same decimal sign"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace enfilade
