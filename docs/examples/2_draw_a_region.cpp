// Where may the COM of a stance be? Writes a picture to the file that is named, else to region.svg.
// Prints:
//   balance alone 0.99648 m2, robustly stable 0.63402 m2, to within 1e-06 m2: yes
//   FF is possible in 0.36246 m2
//   FU is possible in 0.27461 m2
//   UF is possible in 0.13243 m2
//   UU is possible in 0.08601 m2
#include <cstdio>
#include <fstream>
#include <surefoot/gaits/region_svg.hpp>

using namespace surefoot;

int main(int count, char** words) {
  gaits::RegionFigure figure;
  figure.title = "uneven";
  figure.contacts = {{.position = {0, 0}, .normal = {0.574, 0.819}, .friction = 0.5},
                     {.position = {1, 0.1}, .normal = {-0.174, 0.985}, .friction = 0.5}};
  figure.contact_names = {"1", "2"};
  figure.radius_of_gyration = 0.1;
  figure.box = {.centre = {}, .kappa = 0.17, .nu = 0.1};

  const stability::Region region = stability::region(figure.contacts, figure.radius_of_gyration, figure.box);
  std::printf("balance alone %.5f m2, robustly stable %.5f m2, to within 1e-06 m2: %s\n", region.equilibrium_area,
              region.robust_area, region.area_error < 1e-6 ? "yes" : "no");
  for (const stability::ModeShare& share : region.modes)
    std::printf("%s is possible in %.5f m2\n", share.mode.name().c_str(), share.area);

  const char* const picture = count > 1 ? words[1] : "region.svg";
  std::ofstream file(picture);
  file << gaits::to_svg(figure, region);
  if (file.flush()) return 0;
  std::fprintf(stderr, "cannot write %s\n", picture);
  return 1;
}
