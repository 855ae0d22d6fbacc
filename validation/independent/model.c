#include "model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

Model M;

void die(const char *what, const char *detail)
{
    fprintf(stderr, "model: %s %s\n", what, detail);
    exit(2);
}

void *need(size_t n, size_t size)
{
    void *p = calloc(n ? n : 1, size);
    if (!p) die("out of memory", "");
    return p;
}

int pick(const char *w, const char *names[], int count)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(w, names[i])) return i;
    die("unknown word", w);
    return -1;
}
