// Formatted output into memory: the subset of printf's format language that the program uses (rt.h lists it).
#include "rt.h"

namespace {

// The destination of the text: counts every character, stores those that fit before the final 0.
class Sink {
public:
    Sink(char* to, size_t size) : to_(to), size_(size) {}

    void put(char c) {
        if (length_ + 1 < size_)
            to_[length_] = c;
        ++length_;
    }

    void fill(char c, int count) {
        for (; count > 0; --count)
            put(c);
    }

    int finish() {
        if (size_ > 0)
            to_[length_ < size_ ? length_ : size_ - 1] = '\0';
        return int(length_);
    }

private:
    char* to_;
    size_t size_;
    size_t length_ = 0;
};

// The part of a conversion between '%' and the letter.
struct Form {
    bool left = false;
    bool zero = false;
    int width = 0;
    int precision = -1;
};

void putField(Sink* sink, const Form& form, const char* text, int length)
{
    if (!form.left)
        sink->fill(' ', form.width - length);
    for (int i = 0; i < length; ++i)
        sink->put(text[i]);
    if (form.left)
        sink->fill(' ', form.width - length);
}

void putNumber(Sink* sink, const Form& form, uint32_t value, uint32_t base, bool minus)
{
    char digits[12];
    int at = sizeof digits;
    do {
        digits[--at] = "0123456789abcdef"[value % base];
        value /= base;
    } while (value != 0);
    const int length = int(sizeof digits) - at + (minus ? 1 : 0);
    const bool zeros = form.zero && !form.left;
    if (zeros && minus) {
        sink->put('-');
        minus = false;
    }
    if (zeros) {
        sink->fill('0', form.width - length);
        putField(sink, Form(), digits + at, int(sizeof digits) - at);
        return;
    }
    if (minus)
        digits[--at] = '-';
    putField(sink, form, digits + at, length);
}

}  // namespace

extern "C" {

int vsnprintf(char* to, size_t size, const char* format, va_list args)
{
    Sink sink(to, size);
    for (; *format != '\0'; ++format) {
        if (*format != '%') {
            sink.put(*format);
            continue;
        }
        ++format;
        Form form;
        for (;; ++format) {
            if (*format == '-')
                form.left = true;
            else if (*format == '0')
                form.zero = true;
            else
                break;
        }
        for (; *format >= '0' && *format <= '9'; ++format)
            form.width = form.width * 10 + (*format - '0');
        if (*format == '.') {
            ++format;
            form.precision = 0;
            if (*format == '*') {
                form.precision = va_arg(args, int);
                ++format;
            }
            for (; *format >= '0' && *format <= '9'; ++format)
                form.precision = form.precision * 10 + (*format - '0');
        }
        while (*format == 'l') {  // long is int here
            ++format;
        }
        switch (*format) {
            case 'd': {
                const int value = va_arg(args, int);
                putNumber(&sink, form, value < 0 ? 0u - uint32_t(value) : uint32_t(value), 10, value < 0);
                break;
            }
            case 'u':
                putNumber(&sink, form, va_arg(args, uint32_t), 10, false);
                break;
            case 'x':
                putNumber(&sink, form, va_arg(args, uint32_t), 16, false);
                break;
            case 'c': {
                const char c = char(va_arg(args, int));
                putField(&sink, form, &c, 1);
                break;
            }
            case 's': {
                const char* text = va_arg(args, const char*);
                int length = 0;
                while (length != form.precision && text[length] != '\0')
                    ++length;
                putField(&sink, form, text, length);
                break;
            }
            case '%':
                sink.put('%');
                break;
            default:
                // An unknown conversion is printed as it is: a silent loss would hide the mistake.
                sink.put('%');
                --format;
                break;
        }
    }
    return sink.finish();
}

int snprintf(char* to, size_t size, const char* format, ...)
{
    va_list args;
    va_start(args, format);
    const int length = vsnprintf(to, size, format, args);
    va_end(args);
    return length;
}

}  // extern "C"
