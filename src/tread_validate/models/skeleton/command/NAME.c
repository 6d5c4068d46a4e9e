/* A tread block as a Winkler foundation: NAME CASE.json HISTORY.csv
   Independent columns of the instantaneous modulus, shear modulus a third of it, static friction at their ends. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TIMES = 600, COLUMNS = 200 };

static char *text;

static void fail(const char *what, const char *which)
{
    fprintf(stderr, "NAME: %s: %s\n", what, which);
    exit(2);
}

static void read_file(const char *name)
{
    FILE *in = fopen(name, "rb");
    if (!in) fail("no such file", name);
    fseek(in, 0, SEEK_END);
    long size = ftell(in);
    rewind(in);
    text = malloc((size_t)size + 1);
    if (!text || fread(text, 1, (size_t)size, in) != (size_t)size) fail("cannot read", name);
    text[size] = '\0';
    fclose(in);
}

/* The value behind "a" "b" "c": each key is looked for after the one before it, as the file keeps them in order. */
static char *value(const char *const *keys)
{
    char *at = text;
    for (; *keys; keys++) {
        char name[64];
        snprintf(name, sizeof name, "\"%s\":", *keys);
        at = strstr(at, name);
        if (!at) fail("no key", *keys);
        at += strlen(name);
    }
    return at;
}
#define AT(...) value((const char *const[]){__VA_ARGS__, NULL})

static double number(char *at)
{
    return strtod(at, NULL);
}

static int numbers(char *at, double **out)
{
    int n = 0, room = 64;
    double *list = malloc(sizeof *list * (size_t)room);
    at = strchr(at, '[');
    while (*at != ']') {
        if (n == room) list = realloc(list, sizeof *list * (size_t)(room *= 2));
        list[n++] = strtod(at + 1, &at);
        at += strspn(at, " \n");
    }
    *out = list;
    return n;
}

static double interpolate(double at, const double *x, const double *y, int n)
{
    int low = 0, high = n - 1;
    if (at <= x[0]) return y[0];
    if (at >= x[high]) return y[high];
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (x[middle] <= at) low = middle; else high = middle;
    }
    return y[low] + (y[high] - y[low]) * (at - x[low]) / (x[high] - x[low]);
}

int main(int count, char **arguments)
{
    if (count != 3) fail("usage", "NAME CASE.json HISTORY.csv");
    read_file(arguments[1]);
    double modulus = number(AT("compound", "long_term_modulus_Pa"));
    for (char *at = AT("compound", "terms"), *end = AT("compound", "poissons_ratio");
         (at = strstr(at, "\"modulus_Pa\":")) && at < end; at++)
        modulus += number(at + strlen("\"modulus_Pa\":"));
    double friction = number(AT("friction", "static_coefficient"));
    double duration = 1.02 * number(AT("expected_duration_s"));
    double first = number(AT("path", "first_contact_arc_m")), speed = number(AT("path", "arc_speed_m_s"));
    double road_speed = number(AT("road", "surface_speed_m_s"));
    char *radius_text = AT("road", "radius_m");
    int plane = strncmp(radius_text + strspn(radius_text, " "), "null", 4) == 0;
    double radius = plane ? 0.0 : number(radius_text);

    double *width_s, *width, *column_s, *column_offset, *column_height, *arc, *x, *y, *slope;
    int widths = numbers(AT("width_profile", "s_m"), &width_s);
    numbers(AT("width_profile", "width_m"), &width);
    int columns = numbers(AT("columns", "s_m"), &column_s);
    numbers(AT("columns", "arc_offset_m"), &column_offset);
    numbers(AT("columns", "height_m"), &column_height);
    int samples = numbers(AT("samples", "arc_m"), &arc);
    numbers(AT("samples", "x_m"), &x);
    numbers(AT("samples", "y_m"), &y);
    numbers(AT("samples", "slope_rad"), &slope);

    double cell = column_s[columns - 1] / COLUMNS, step = duration / TIMES;
    double offset[COLUMNS], height[COLUMNS], area[COLUMNS], shear[COLUMNS] = {0}, before[COLUMNS] = {0};
    for (int i = 0; i < COLUMNS; i++) {
        double s = (i + 0.5) * cell;
        offset[i] = interpolate(s, column_s, column_offset, columns);
        height[i] = interpolate(s, column_s, column_height, columns);
        area[i] = cell * interpolate(s, width_s, width, widths);
    }

    FILE *out = fopen(arguments[2], "w");
    if (!out) fail("cannot write", arguments[2]);
    fprintf(out, "# case_digest: %.64s\n", strchr(AT("case_digest"), '"') + 1);
    fprintf(out, "time_s,normal_force_N,tangential_force_N\n");
    for (int row = 0; row <= TIMES; row++) {
        double t = row * step, normal = 0.0, tangential = 0.0;
        for (int i = 0; i < COLUMNS; i++) {
            double at = first + speed * t - offset[i], lean = interpolate(at, arc, slope, samples);
            double end_x = interpolate(at, arc, x, samples) + height[i] * sin(lean);
            double end_y = interpolate(at, arc, y, samples) - height[i] * cos(lean);
            double depth = plane ? -end_y : radius - hypot(end_x, end_y + radius);
            double pressure = depth > 0.0 ? modulus * depth / height[i] : 0.0;
            if (row) shear[i] += (road_speed * step - (end_x - before[i])) * modulus / 3.0 / height[i];
            shear[i] = depth > 0.0 ? fmax(-friction * pressure, fmin(friction * pressure, shear[i])) : 0.0;
            before[i] = end_x;
            normal += pressure * area[i];
            tangential -= shear[i] * area[i];
        }
        fprintf(out, "%.12g,%.12g,%.12g\n", t, normal, tangential);
    }
    return fclose(out) ? 2 : 0;
}
