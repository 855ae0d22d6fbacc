/* Numbers that the text states, and laws that must hold. */
#ifndef FACTS_H
#define FACTS_H

int facts(void);
int balance_of_flows(double *q, double *v);

#endif
