/* Reading the parameter text. */
#ifndef PARAMETERS_H
#define PARAMETERS_H

void open_text(const char *path);
double num(void);
int integer(void);
void read_model(const char *path);

#endif


