/* Prints the size of each struct of the header and where its fields begin. */
#include "heatpath.h"

#include <stddef.h>
#include <stdio.h>

#define SIZE(type) printf(#type " %u\n", (unsigned)sizeof(type))
#define AT(type, field) printf(#type "." #field " %u\n", (unsigned)offsetof(type, field))

int main(void)
{
    SIZE(hp_buffer);
    AT(hp_buffer, data);
    AT(hp_buffer, spacing);
    SIZE(hp_options);
    AT(hp_options, smoothing);
    AT(hp_options, estimator);
    AT(hp_options, user);
    AT(hp_options, solver);
    AT(hp_options, reference);
    AT(hp_options, memory);
    AT(hp_options, farthest);
    AT(hp_options, tensor);
    AT(hp_options, tensor_count);
    SIZE(hp_path_info);
    AT(hp_path_info, source);
    AT(hp_path_info, distance);
    return 0;
}
