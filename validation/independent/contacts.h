/* The elastic force of a contact in centred geometry: the law `ecl`, and healthy slices. */
#ifndef CONTACTS_H
#define CONTACTS_H

typedef struct {
    double elastic;   /* K times the bracketed sum */
    double stiffness; /* its derivative by delta */
    double length;    /* L_e of the acting defect */
} Elastic;

double factor(double Ls);
Elastic elastic_law(int side, int row, int j, double theta, double phi, double W, double delta, int slope);
double sliced_force(int side, double delta, double rate, double tilt, double tilt_rate, double *T);

#endif
