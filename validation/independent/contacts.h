/* The laws of contact, `ecl` and `sliced`. */
#ifndef CONTACTS_H
#define CONTACTS_H

typedef struct {
    double elastic;   /* K times the bracketed sum */
    double stiffness; /* its derivative by delta */
    double length;    /* L_e of the acting defect (ecl) */
    double push;      /* -dE/du of the damage's slopes, all of it */
    double push_own;  /* the part that damage on the roller has in it */
} Elastic;

double factor(double Ls);
Elastic elastic_law(int side, int row, int j, double theta, double phi, double W, double delta, int slope);

#endif
