/* What the test programs share: checks, and a small picture to run on. */
#ifndef CHECK_H
#define CHECK_H

#include "heatpath.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 24, HEIGHT = 18, PIXELS = WIDTH * HEIGHT };

static int failures;

static void complain(int line, const char *what, const char *why)
{
    printf("line %d: %s: %s\n", line, what, why);
    failures++;
}

/* The call must return the status, and, if that is a failure, leave a line with the words. */
static void expect(int line, const char *call, hp_status got, hp_status wanted, const char *words)
{
    const char *message = hp_last_error_message();
    if (got != wanted) {
        complain(line, call, hp_status_name(got));
        if (got != HP_OK)
            printf("    %s\n", message);
    } else if (got != HP_OK) {
        if (strlen(message) < 10 || strchr(message, '\n') || !strstr(message, words))
            complain(line, call, message);
    }
}

#define EXPECT(wanted, words, call) expect(__LINE__, #call, (call), (wanted), (words))
#define CHECK(condition) ((condition) ? (void)0 : complain(__LINE__, #condition, "is not true"))

/* A picture with a bright diagonal band. */
static inline double grey(int x, int y)
{
    return 0.2 + 0.6 * exp(-0.05 * (x - y) * (x - y)) + 0.01 * ((7 * x + 3 * y) % 5);
}

/* Describes pixels without gaps. */
static inline hp_buffer buffer_of(void *data, uint32_t type)
{
    hp_buffer buffer;
    EXPECT(HP_OK, "", hp_buffer_init(&buffer, sizeof buffer));
    buffer.data = data;
    buffer.type = type;
    buffer.size[0] = WIDTH;
    buffer.size[1] = HEIGHT;
    return buffer;
}

static inline hp_options defaults(void)
{
    hp_options options;
    EXPECT(HP_OK, "", hp_options_init(&options, sizeof options));
    options.threads = 1;
    return options;
}

#endif
