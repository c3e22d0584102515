// What fabrics, and pieces, edges, lines and marks of a garment are called.
#include "design/glossary/terms.h"

namespace karinui {

TermTable fabricTerms() {
  static const std::vector<NamedTerm> all{
      {"chiffon", say("Chiffon")},
      {"cotton", say("Cotton")},
      {"denim", say("Denim")},
      {"interfacing", say("Interfacing")},
      {"interlock", say("Interlock knit")},
      {"leather", say("Leather")},
      {"jersey", say("Jersey")},
      {"linen", say("Linen")},
      {"silk", say("Silk")},
      {"simcloth", say("Historical test cloth")},
      {"velvet", say("Velvet")},
      {"viscose", say("Viscose")},
      {"wool coating", say("Wool coating")},
      {"wool suiting", say("Wool suiting")},
  };
  return all;
}

TermTable wordTerms() {
  static const std::vector<NamedTerm> all{
      {"ankle", say("ankle")},
      {"armhole", say("armhole")},
      {"back", say("back")},
      {"belt", say("belt")},
      {"bodice", say("bodice")},
      {"bottom", say("bottom edge")},
      {"btorso", say("back bodice")},
      {"cap", say("sleeve cap")},
      {"center", say("centre")},
      {"centre", say("centre")},
      {"collar", say("collar")},
      {"crotch", say("crotch")},
      {"crown", say("sleeve crown")},
      {"cuff", say("cuff")},
      {"cut", say("cut edge")},
      {"dart", say("dart")},
      {"edge", say("edge")},
      {"elbow", say("elbow")},
      {"end", say("end")},
      {"facing", say("facing")},
      {"fold", say("fold")},
      {"front", say("front")},
      {"ftorso", say("front bodice")},
      {"gusset", say("gusset")},
      {"hem", say("hem")},
      {"hip", say("hip")},
      {"hood", say("hood")},
      {"inseam", say("inseam")},
      {"knee", say("knee")},
      {"lap", say("lap")},
      {"leg", say("trouser leg")},
      {"line", say("line")},
      {"lining", say("lining")},
      {"low", say("lower edge")},
      {"neck", say("neckline")},
      {"neckline", say("neckline")},
      {"notch", say("notch")},
      {"opening", say("opening")},
      {"outseam", say("outseam")},
      {"panel", say("panel")},
      {"piece", say("piece")},
      {"placket", say("placket")},
      {"pocket", say("pocket")},
      {"rise", say("rise")},
      {"seam", say("seam")},
      {"shoulder", say("shoulder")},
      {"side", say("side")},
      {"skirt", say("skirt")},
      {"sleeve", say("sleeve")},
      {"strap", say("strap")},
      {"top", say("top edge")},
      {"torso", say("bodice")},
      {"under", say("underarm")},
      {"underarm", say("underarm")},
      {"waist", say("waist")},
      {"waistband", say("waistband")},
      {"wrist", say("sleeve opening")},
      {"yoke", say("yoke")},
  };
  return all;
}

}  // namespace karinui
