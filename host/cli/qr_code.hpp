// An address as a QR code (ISO/IEC 18004, by libqrencode), for the camera of a phone.
#pragma once

#include <string>

namespace unicursal::host {

/// Lines of half blocks: a character shows two modules, one above the other. Light modules are drawn and dark
/// ones left out, for terminals with light letters on a dark ground; cameras read the opposite as well. Four
/// light modules surround the code, as the standard asks. Empty if the text is too long.
std::string qr_code(const std::string& text);

}  // namespace unicursal::host
