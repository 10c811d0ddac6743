// Video: mode 13h of a VGA, 320x200 pixels in 256 colours, one byte per pixel from A000:0000 on.
#include "machine.h"
#include "pc.h"
#include "rt.h"

// asm/blit.S: copies the spans of `count` rows of `frame` (320 bytes per row) to the same places at selector:offset.
extern "C" void presentRows(uint32_t selector, uint32_t offset, const uint8_t* frame, const Span* rows, int count);

namespace {

constexpr uint16_t SCREEN_SEGMENT = 0xa000;
constexpr uint16_t DAC_INDEX = 0x3c8;
constexpr uint16_t DAC_DATA = 0x3c9;
constexpr uint16_t STATUS = 0x3da;
constexpr uint8_t IN_RETRACE = 0x08;
constexpr uint32_t BIOS_LAST_ROW = 0x484;  // address of the number of text rows minus 1
constexpr uint8_t MODE_13H = 0x13;

bool open = false;
uint16_t screen = 0;  // selector
uint8_t oldMode;
uint8_t oldLastRow;

void setMode(uint8_t mode)
{
    dpmi::RealRegs r = pc::regs(mode);
    dpmi::realInterrupt(0x10, &r);
}

uint8_t currentMode()
{
    dpmi::RealRegs r = pc::regs(0x0f00);
    dpmi::realInterrupt(0x10, &r);
    return uint8_t(r.eax & 0x7f);
}

// int 10h, AX=1A00h, exists on VGA and MCGA cards, which both have mode 13h, but not on older cards.
bool haveVga()
{
    dpmi::RealRegs r = pc::regs(0x1a00);
    if (!dpmi::realInterrupt(0x10, &r) || uint8_t(r.eax) != 0x1a)
        return false;
    const uint8_t card = uint8_t(r.ebx);
    return card >= 0x07 && card <= 0x0c && card != 0x09;
}

}  // namespace

namespace machine {

const char* openVideo()
{
    if (open)
        return nullptr;
    if (!haveVga())
        return "no VGA found";
    if (screen == 0) {
        screen = dpmi::segmentDescriptor(SCREEN_SEGMENT);
        if (screen == 0)
            return "no selector for the screen";
    }
    oldMode = currentMode();
    oldLastRow = pc::peek8(BIOS_LAST_ROW);
    open = true;
    setMode(MODE_13H);
    if (currentMode() != MODE_13H) {
        closeVideo();
        return "no mode 13h on this card";
    }
    return nullptr;
}

void closeVideo()
{
    if (!open)
        return;
    open = false;
    setMode(oldMode);
    // A text screen of 50 (or 28) lines is the mode of 25 lines with a smaller font, which must be loaded again.
    if (oldMode <= 3 && (oldLastRow == 49 || oldLastRow == 27)) {
        dpmi::RealRegs r = pc::regs(oldLastRow == 49 ? 0x1112 : 0x1111);
        dpmi::realInterrupt(0x10, &r);
    }
}

void setPalette(const uint8_t rgb[768])
{
    if (!open)
        return;
    pc::outPort(DAC_INDEX, 0);
    uint32_t bytes = 768;
    __asm__ volatile("rep outsb" : "+S"(rgb), "+c"(bytes) : "d"(DAC_DATA) : "memory");
}

void present(const uint8_t* frame, const Span rows[HEIGHT])
{
    if (open)
        presentRows(screen, 0, frame, rows, HEIGHT);
}

void waitRetrace()
{
    if (!open)
        return;
    const uint64_t end = clock() + CLOCK_HZ / 20;
    while ((pc::inPort(STATUS) & IN_RETRACE) != 0 && clock() < end) {
    }
    while ((pc::inPort(STATUS) & IN_RETRACE) == 0 && clock() < end) {
    }
}

}  // namespace machine
