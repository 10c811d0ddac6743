// Keyboard and mouse: int 16h, called only when a key is waiting, and int 33h, called only when there is a mouse.
#include "machine.h"
#include "pc.h"

namespace {

constexpr uint32_t KEYBOARD_FLAGS = 0x417;
constexpr uint8_t CAPS_LOCK = 0x40;
constexpr uint32_t KEYBOARD_KIND = 0x496;
constexpr uint8_t ENHANCED = 0x10;

constexpr int MOUSE = 0x33;
constexpr uint8_t IRET = 0xcf;

bool mouseOpen = false;

}  // namespace

namespace machine {

int key()
{
    while (pc::peek16(pc::KEYS_HEAD) != pc::peek16(pc::KEYS_TAIL)) {
        // AH=10h also returns the keys of an enhanced keyboard; AH=00h would skip such a key and wait for another one.
        dpmi::RealRegs r = pc::regs((pc::peek8(KEYBOARD_KIND) & ENHANCED) != 0 ? 0x1000 : 0x0000);
        if (!dpmi::realInterrupt(0x16, &r))
            return 0;
        const int character = int(r.eax & 0xff);
        const int scan = int(r.eax >> 8 & 0xff);
        if (character == 3) {
            pc::noteBreak();
        } else if (character == 0 || (character == 0xe0 && scan != 0)) {
            // Ctrl-Break leaves an entry with character and scan code 0, which is not a key.
            if (scan != 0)
                return 0x100 + scan;
        } else {
            const int letter = character | 0x20;
            const bool turned = letter >= 'a' && letter <= 'z' && (pc::peek8(KEYBOARD_FLAGS) & CAPS_LOCK) != 0;
            return turned ? character ^ 0x20 : character;
        }
    }
    return 0;
}

bool openMouse()
{
    // Without a driver the vector is null or points to an iret instruction.
    const dpmi::RealAddress driver = dpmi::realVector(MOUSE);
    const uint32_t at = (uint32_t(driver.segment) << 4) + driver.offset;
    if (at == 0 || pc::peek8(at) == IRET)
        return false;
    dpmi::RealRegs r = pc::regs(0x0000);
    if (!dpmi::realInterrupt(MOUSE, &r) || uint16_t(r.eax) != 0xffff)
        return false;
    mouseOpen = true;
    mouse();  // discards earlier movements and presses
    return true;
}

Mouse mouse()
{
    Mouse now = {0, 0, 0, false, false};
    if (!mouseOpen)
        return now;
    dpmi::RealRegs r = pc::regs(0x0003);
    if (dpmi::realInterrupt(MOUSE, &r)) {
        now.left = (r.ebx & 1) != 0;
        now.right = (r.ebx & 2) != 0;
    }
    // The driver counts how often the left button was pressed, even while a frame was drawn.
    r = pc::regs(0x0005);
    if (dpmi::realInterrupt(MOUSE, &r))
        now.presses = uint16_t(r.ebx);
    r = pc::regs(0x000b);
    if (dpmi::realInterrupt(MOUSE, &r)) {
        now.dx = int16_t(r.ecx);
        now.dy = int16_t(r.edx);
    }
    return now;
}

}  // namespace machine

namespace pc {

void closeMouse()
{
    if (mouseOpen) {
        mouseOpen = false;
        dpmi::RealRegs r = regs(0x0000);
        dpmi::realInterrupt(MOUSE, &r);
    }
}

}  // namespace pc
